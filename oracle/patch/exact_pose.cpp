#include "oracle/patch/exact_pose.hpp"

#include "oracle/exact_rotation.hpp"

namespace touchstone::oracle {

RationalVector exact(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 rounded(const RationalVector& v) { return {v.x.get_d(), v.y.get_d(), v.z.get_d()}; }

ExactPose::ExactPose(const Pose& pose) : position(exact(pose.position())) {
  const Eigen::Quaterniond& q = pose.orientation();
  const ExactRotation<mpq_class> rotation(q.w(), q.x(), q.y(), q.z());
  axes = rotation.columns;
  norm = rotation.norm;
}

}  // namespace touchstone::oracle
