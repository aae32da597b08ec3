#include "oracle/patch/exact_pose.hpp"

namespace touchstone::oracle {

RationalVector exact(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Vec3 rounded(const RationalVector& v) { return {v.x.get_d(), v.y.get_d(), v.z.get_d()}; }

ExactPose::ExactPose(const Pose& pose) : position(exact(pose.position())) {
  const Eigen::Quaterniond& q = pose.orientation();
  const mpq_class w = q.w(), x = q.x(), y = q.y(), z = q.z();
  const mpq_class ww = w * w, xx = x * x, yy = y * y, zz = z * z;
  const mpq_class wx = w * x, wy = w * y, wz = w * z, xy = x * y, xz = x * z, yz = y * z;
  axes = {RationalVector{ww + xx - yy - zz, 2 * (xy + wz), 2 * (xz - wy)},
          RationalVector{2 * (xy - wz), ww - xx + yy - zz, 2 * (yz + wx)},
          RationalVector{2 * (xz + wy), 2 * (yz - wx), ww - xx - yy + zz}};
  norm = ww + xx + yy + zz;
}

}  // namespace touchstone::oracle
