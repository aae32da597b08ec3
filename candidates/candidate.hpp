#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "candidates/candidate.h"

namespace touchstone {

/// What a plug-in says of one of its candidates. The routine itself is never called in this process
/// (see candidate_process.hpp).
struct Candidate {
  struct Parameter {
    std::string meaning;
    double least, most, usual;
    bool whole, bare;
  };

  std::string name;      ///< of a family's member with its parameter: "prism:16"
  std::string family;    ///< the name without the parameter: "prism"
  std::string version;   ///< of the engine
  std::string settings;  ///< how it is called
  std::string models;    ///< what stands for the shapes; empty when they are taken as they are
  std::optional<Parameter> parameter;
  double value = 0;                   ///< of the parameter
  std::array<bool, 5> supports{};     ///< by ts_shape_kind
  std::filesystem::path plugin = {};  ///< absolute
  int index = 0;                      ///< among the plug-in's candidates
};

}  // namespace touchstone
