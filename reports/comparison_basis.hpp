#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace touchstone {

/// What two reports have in common, and everything else that a person must know before reading
/// differences into them.
struct ComparisonBasis {
  bool same_configurations = true;  ///< seed and count
  bool same_bar = true;             ///< tolerance and threshold
  bool same_classes = true;
  bool times = true;  ///< both have the baseline that times are related to
  nlohmann::json remarks = nlohmann::json::array();  ///< sentences

  void remark(const std::string& text) { remarks.push_back(text); }
};

/// Of two reports as read_report gives them.
ComparisonBasis comparison_basis(const nlohmann::json& before, const nlohmann::json& after,
                                 const std::string& baseline);

}  // namespace touchstone
