// Causes of failures: what tells them apart, and their order.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <tuple>

#include "oracle/first_touch.hpp"
#include "properties/casts.hpp"
#include "properties/laws/cast_laws.hpp"
#include "properties/simplify.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr double aligned = 1e-6;  // radians

/// The unit normal in a body's frame.
Vec3 in_frame(const Pose& pose, const Vec3& n) { return pose.rotation().transpose() * n; }

bool is_along(const Vec3& local) { return std::hypot(local.x(), local.y()) < aligned; }
bool is_across(const Vec3& local) { return std::abs(local.z()) < aligned; }

struct FeatureAlong {
  Vec3 n;  // in the body's frame

  std::string operator()(const Cylinder&) const {
    return is_along(n) ? "cap" : is_across(n) ? "side" : "rim";
  }
  std::string operator()(const Capsule&) const { return is_across(n) ? "side" : "end"; }
  std::string operator()(const Sphere&) const { return "sphere"; }
  std::string operator()(const Plane&) const { return "plane"; }
  std::string operator()(const Convex& s) const {
    const auto across = [&](const Convex::Edge& e) {
      const Vec3 along = s.vertices()[e.vertices[1]] - s.vertices()[e.vertices[0]];
      return std::abs(along.normalized().dot(n)) < aligned;
    };
    for (const Convex::Face& face : s.faces()) {
      if (face.normal.cross(n).norm() < aligned && face.normal.dot(n) > 0) return "face";
    }
    const auto height = [&](int v) { return s.vertices()[v].dot(n); };
    double highest = -std::numeric_limits<double>::infinity();
    for (const Vec3& v : s.vertices()) highest = std::max(highest, v.dot(n));
    const double within = aligned * s.half_extents().maxCoeff();
    for (const Convex::Edge& e : s.edges()) {
      if (across(e) && height(e.vertices[0]) > highest - within) return "edge";
    }
    return "vertex";
  }
  std::string operator()(const Box&) const {
    switch ((n.array().abs() < aligned).count()) {
      case 2:
        return "face";
      case 1:
        return "edge";
      default:
        return "vertex";
    }
  }
};

}  // namespace

namespace {

std::string features_along(const oracle::Truth& truth, const Configuration& c) {
  if (truth.ties != oracle::Ties::unique) return "tied";
  const Vec3& n = truth.normals.front().n;
  return FeatureAlong{in_frame(c.pose_a, n)}(c.a) + '-' +
         std::visit(FeatureAlong{in_frame(c.pose_b, n)}, c.b);
}

}  // namespace

std::string meeting_features(const Configuration& c) { return features_along(oracle::truth(c), c); }
std::string meeting_features(const CastQuestion& cast) {
  const auto touch = oracle::first_touch(cast.configuration, Sweep(cast.sweep));
  return touch.there ? features_along(*touch.there, cast.configuration) : "apart";
}

bool Cause::operator<(const Cause& other) const {
  return std::tie(law, pair, features, failure) <
         std::tie(other.law, other.pair, other.features, other.failure);
}

Cause cause_of(const Failure& f) {
  const auto features = [&] {
    if (!f.features.empty()) return f.features;
    return f.sweep ? meeting_features(CastQuestion{f.configuration, *f.sweep})
                   : meeting_features(f.configuration);
  };
  return {f.law, pair_of(f.configuration), features(), f.violation.failure};
}

std::string to_string(const Cause& cause) {
  return cause.law + ", " + pair_name(cause.pair) + ", " + cause.features + ", " + cause.failure;
}

std::optional<Group> group_met(const Failure& f) {
  try {
    const Identity met = is_cast_identity(f.identity) ? parse_cast_identity(f.identity).pose
                                                      : parse_identity(f.identity);
    return met.pose_class.group();
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

int order_of(std::optional<Group> group) {
  constexpr Group order[] = {Group::everyday, Group::degenerate, Group::recorded, Group::extreme};
  const auto at = group ? std::find(std::begin(order), std::end(order), *group) : std::end(order);
  return static_cast<int>(at - std::begin(order));
}

std::vector<Failure> in_order(const std::vector<LawResult>& results) {
  std::vector<Failure> all;
  for (const LawResult& result : results) {
    all.insert(all.end(), result.failures.begin(), result.failures.end());
  }
  const auto rank = [](const Failure& f) {
    return std::tuple(place_of_law(f.law), order_of(group_met(f)), ~f.met,
                      complexity(f.configuration));
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const Failure& a, const Failure& b) { return rank(a) < rank(b); });
  return all;
}

std::vector<LawResult> new_ones(std::vector<LawResult> results, const std::vector<Failure>& known) {
  std::set<Cause> causes;
  for (const Failure& failure : known) causes.insert(cause_of(failure));
  for (LawResult& result : results) {
    result.broken = 0;
    result.counts.clear();
    std::erase_if(result.failures, [&](const Failure& f) {
      const bool is_known = causes.contains(cause_of(f));
      if (is_known) result.known[f.violation.failure] += f.met;
      return is_known;
    });
    for (const Failure& f : result.failures) {
      result.broken += f.met;
      result.counts[f.violation.failure] += f.met;
    }
  }
  return results;
}

}  // namespace touchstone
