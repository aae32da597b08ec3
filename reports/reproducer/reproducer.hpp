#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"

namespace touchstone {

/// Engines that a reproducer can be written for: "bullet", "ode", "fcl", "libccd", "mujoco".
std::vector<std::string> reproducer_engines();

/// One C++ file with a main that asks this engine alone, called as the candidate of that name is
/// (libccd as libccd-gjk), and needs nothing of ours. It prints the engine's answer and what is
/// true, with a proof, and exits with 1 while the answer's depth or normal regret is beyond the
/// bar. Its comment says how to compile it, and what the candidate answered here and now.
/// `asked` names the configuration there.
///
/// Throws InvalidInput (field "--emit") for an engine that is not known or has no routine for the
/// pair.
std::string reproducer(std::string_view engine, const Configuration& configuration,
                       const std::string& asked, const Bar& bar, const Limits& limits = {});

}  // namespace touchstone
