#pragma once

#include <string>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

/// Tests of an engine's contacts as its own project would write them.
struct IdiomRequest {
  std::string idiom;   ///< one of `idioms`
  std::string engine;  ///< a name of `reproducer_engines`; of npm's also a release, "rapier@0.14"
  std::vector<Pair> pairs;
  std::uint64_t seed, limit;
  Bar bar = {};
  Limits limits = {};
};

/// "gtest", …
std::vector<std::string> idioms();

/// One file of tests, with cases (cases.hpp) and a short judge inline, that asks the engine as its
/// reproducer does and needs nothing of ours. Wrong answers of the version that is installed here
/// are what its tests expect. Throws InvalidInput (fields "--as", "--engine", "--pair").
std::string idiom_file(const IdiomRequest& request);

}  // namespace touchstone
