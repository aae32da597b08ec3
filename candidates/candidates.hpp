#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "candidates/candidate.h"
#include "reference/configuration.hpp"

namespace touchstone {

/// Every candidate built into the program, in the order in which reports list them.
std::span<const ts_candidate* const> all_candidates();

/// The candidate of that name. Throws InvalidInput (field "--candidates") naming those there are.
const ts_candidate& find_candidate(std::string_view name);

/// A configuration's shapes and poses as the C interface passes them: quaternions and plane
/// normals normalised in double.
ts_shape to_ts_shape(const Shape& shape);
ts_pose to_ts_pose(const Pose& pose);

/// Two shapes prepared by one candidate; released at the end of its life.
class PreparedPair {
 public:
  PreparedPair(const ts_candidate& candidate, const Cylinder& a, const Shape& b, double threshold);
  /// TS_UNSUPPORTED when the candidate has no routine for the pair. Points beyond
  /// TOUCHSTONE_MAX_POINTS are a candidate's error and are reported as TS_FAILED.
  ts_answer query(const ts_pose& a, const ts_pose& b) const;

 private:
  const ts_candidate* candidate_;
  std::unique_ptr<ts_prepared, void (*)(ts_prepared*)> prepared_;
};

/// One query of one configuration, shapes prepared and released for it.
ts_answer answer(const ts_candidate& candidate, const Configuration& configuration,
                 double threshold);

}  // namespace touchstone
