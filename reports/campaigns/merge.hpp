#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/campaigns/shard_file.hpp"

namespace touchstone {

/// Puts parts of one campaign together, one after the other. The sum does not depend on how the
/// campaign was cut nor on the order of the parts.
class Merge {
 public:
  /// `file` is what errors call the part. Throws InvalidInput where it belongs to another campaign
  /// or holds a unit that an earlier part holds.
  void add(const Progressed& part, const std::string& file);

  /// As the only shard of all. Throws InvalidInput where units are missing, unless they may, or
  /// without any part.
  Progressed whole(bool may_be_partial) const;

 private:
  struct Part {
    std::string file;
    UnitSet units;
  };
  std::vector<Progressed> sum_;  ///< One, once there is a part.
  std::vector<Part> parts_;
};

/// Of shard files, and of folders that hold some. Throws InvalidInput as Merge and
/// progressed_from_text do.
Progressed merge(const std::vector<std::filesystem::path>& inputs, bool may_be_partial);

}  // namespace touchstone
