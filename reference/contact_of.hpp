#pragma once

#include "configuration.hpp"
#include "contact.hpp"

namespace touchstone {

// The questions of contact.hpp, asked of a configuration.

inline SignedDistance signed_distance(const Configuration& c) {
  return std::visit([&](const auto& b) { return signed_distance(c.a, c.pose_a, b, c.pose_b); },
                    c.b);
}

inline CertifiedDistance certified_distance(const Configuration& c) {
  return std::visit([&](const auto& b) { return certified_distance(c.a, c.pose_a, b, c.pose_b); },
                    c.b);
}

inline bool overlaps(const Configuration& c) {
  return std::visit([&](const auto& b) { return overlaps(c.a, c.pose_a, b, c.pose_b); }, c.b);
}

inline Contact contact(const Configuration& c, double contact_threshold,
                       const Vec3* previous_normal = nullptr,
                       PointRange range = PointRange::near_deepest) {
  return std::visit(
      [&](const auto& b) {
        return contact(c.a, c.pose_a, b, c.pose_b, contact_threshold, previous_normal, range);
      },
      c.b);
}

}  // namespace touchstone
