#include "verification/fuzz/disagreement.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace touchstone {
namespace {

/// What README promises of distances and normals, relative to `scale`; and of the deepest point's
/// depth.
constexpr double promised = 1e-13, promised_above = 1e-12, promised_below = 1e-6;

/// The larger size, or how far the bodies or the plane are apart.
double scale_of(const Configuration& c) {
  const auto* plane = std::get_if<Plane>(&c.b);
  return std::max({larger_size(c), (c.pose_a.position() - c.pose_b.position()).stableNorm(),
                   plane ? std::abs(plane->unit_displacement()) : 0});
}

std::optional<std::string> contradiction(const OwnAnswers& own, double scale) {
  const double sigma = own.certified.value, rounding = promised * scale;
  if (!(std::abs(own.distance.value - sigma) <= rounding)) {
    return fmt::format("signed_distance {:a}, certified_distance {:a}", own.distance.value, sigma);
  }
  const bool is_contact = !own.contact.points().empty();
  if (std::abs(sigma) > rounding && (own.overlaps != (sigma < 0) || is_contact != (sigma < 0))) {
    return fmt::format("certified_distance {:a}, overlaps {}, contact {}", sigma, own.overlaps,
                       is_contact);
  }
  if (!is_contact) return std::nullopt;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const ContactPoint& p : own.contact.points()) deepest = std::max(deepest, p.depth);
  if (!(std::abs(own.contact.signed_distance - sigma) <= rounding)) {
    return fmt::format("contact {:a}, certified_distance {:a}", own.contact.signed_distance, sigma);
  }
  if (!(deepest <= -sigma + promised_above * scale && deepest >= -sigma - promised_below * scale)) {
    return fmt::format("deepest point {:a}, certified_distance {:a}", deepest, sigma);
  }
  return std::nullopt;
}

std::optional<std::string> untruth(const Configuration& c, const OwnAnswers& own, double scale,
                                   const oracle::Truth& truth) {
  const double sigma = truth.signed_distance.midpoint(), rounding = promised * scale;
  if (!(std::abs(own.distance.value - sigma) <= rounding)) {
    return fmt::format("signed_distance {:a}, truth {:a}", own.distance.value, sigma);
  }
  if (!(std::abs(own.certified.value - sigma) <= own.certified.error_bound)) {
    return fmt::format("certified_distance {:a} ± {}, truth {:a}", own.certified.value,
                       own.certified.error_bound, sigma);
  }
  for (const Vec3& n : {own.distance.normal, own.certified.normal}) {
    const double regret = oracle::normal_regret(c, truth, n);
    if (!(regret <= rounding)) return fmt::format("normal regret {}", regret);
  }
  return std::nullopt;
}

}  // namespace

OwnAnswers own_answers(const Configuration& c) {
  return {signed_distance(c), certified_distance(c), contact(c, 0), overlaps(c)};
}

std::optional<std::string> disagreement(const Configuration& c, const OwnAnswers& own,
                                        const oracle::Truth* truth) {
  const double scale = scale_of(c);
  auto found = contradiction(own, scale);
  if (!found && truth) found = untruth(c, own, scale, *truth);
  return found;
}

}  // namespace touchstone
