#include "oracle/judge/score.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "oracle/body.hpp"
#include "oracle/judge/normals.hpp"
#include "oracle/patch/support_feature.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// Signed distance from a box, given how far the point is beyond each pair of parallel faces
/// (negative inside).
double outside_of_all(double x, double y, double z) {
  const double outside = std::hypot(std::max(x, 0.0), std::max(y, 0.0), std::max(z, 0.0));
  return outside > 0 ? outside : std::max({x, y, z});
}

/// The point of a hull's surface nearest to the origin, with the vertices given relative to that,
/// in multiples of `unit`.
Vec3 nearest_on_surface(const Convex& s, const std::vector<Vec3>& vertices, double unit) {
  Vec3 nearest = vertices[0];
  const auto consider = [&](const Vec3& q) {
    if (q.squaredNorm() < nearest.squaredNorm()) nearest = q;
  };
  for (const Convex::Edge& edge : s.edges()) {
    const Vec3& from = vertices[edge.vertices[0]];
    const Vec3 along = vertices[edge.vertices[1]] - from;
    consider(from + std::clamp(-from.dot(along) / along.squaredNorm(), 0.0, 1.0) * along);
  }
  // So far away a face is no nearer than its edges, to an ulp, and rounding could move it anywhere.
  constexpr double far = 1e8;
  if (nearest.norm() > far * (s.half_extents() / unit).norm()) return nearest;
  for (const Convex::Face& face : s.faces()) {
    bool is_above = true;  // or below
    for (std::size_t i = 0; i < face.vertices.size() && is_above; ++i) {
      const Vec3& from = vertices[face.vertices[i]];
      const Vec3& to = vertices[face.vertices[(i + 1) % face.vertices.size()]];
      is_above = from.cross(to - from).dot(face.normal) >= 0;
    }
    if (is_above) consider(vertices[face.vertices[0]].dot(face.normal) * face.normal);
  }
  return nearest;
}

double distance_of_hull(const Convex& s, const Vec3& p) {
  // In multiples of a power of two near the distance's size, so that squares do not overflow.
  const double largest = std::max((p - s.middle()).cwiseAbs().maxCoeff() + largest_half_extent(s),
                                  std::numeric_limits<double>::min());
  const double unit = std::ldexp(1.0, std::min(std::ilogb(largest), 1023));
  std::vector<Vec3> vertices;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : s.vertices()) {
    vertices.emplace_back(v / unit - p / unit);
    mean += vertices.back() / static_cast<double>(s.vertices().size());
  }
  const Vec3 nearest = nearest_on_surface(s, vertices, unit);
  // Inside, the mean of the vertices is on the same side of the nearest point, which no normal of
  // a thin face has to tell. Far away, rounding would.
  const bool is_near = ((p - s.middle()).cwiseAbs().array() <= s.half_extents().array()).all();
  const bool is_inside = is_near && !s.is_flat() && nearest.dot(nearest - mean) > 0;
  return unit * (is_inside ? -nearest.norm() : nearest.norm());
}

/// Signed distance from a body's core, of a point in the body's frame.
double distance_of_core(const oracle::Body& body, const Vec3& p) {
  if (body.hull) return distance_of_hull(*body.hull, p);
  const Vec3 beyond = p.cwiseAbs() - body.core_half_extents();
  if (!body.is_round()) return outside_of_all(beyond.x(), beyond.y(), beyond.z());
  const double side = std::hypot(p.x(), p.y()) - body.core_radius(), cap = beyond.z();
  return side > 0 || cap > 0 ? std::hypot(std::max(side, 0.0), std::max(cap, 0.0))
                             : std::max(side, cap);
}

}  // namespace

double point_distance(const Shape& shape, const Pose& pose, const Vec3& point) {
  const Vec3 local = pose.rotation().transpose() * (point - pose.position());
  if (const auto* const plane = std::get_if<Plane>(&shape)) {
    return plane->unit_normal().dot(local) - plane->unit_displacement();
  }
  const oracle::Body body(shape);
  return distance_of_core(body, local) - body.ball_radius;
}

namespace {

struct OfBodies {
  double a, b;     ///< signed distances from the surfaces
  double allowed;  ///< the point's depth, and what doubles place it to
};

OfBodies distances_of(const Configuration& c, const ts_point& point) {
  const Vec3 p(point.position[0], point.position[1], point.position[2]);
  const double rounding = 1e-15 * p.cwiseAbs().maxCoeff();
  return {point_distance(c.a, c.pose_a, p), point_distance(c.b, c.pose_b, p),
          std::abs(point.depth) + rounding};
}

}  // namespace

double point_excess(const Configuration& c, const ts_point& point) {
  const OfBodies of = distances_of(c, point);
  return std::max(std::abs(of.a), std::abs(of.b)) - of.allowed;
}

double point_outside(const Configuration& c, const ts_point& point) {
  const OfBodies of = distances_of(c, point);
  return std::max(of.a, of.b) - of.allowed;
}

namespace {

/// A normal whose length is not one is the candidate's error; rounding in single precision is not.
constexpr double unit_slack = 1e-6;

Vec3 vector(const double (&v)[3]) { return Vec3(v[0], v[1], v[2]); }

Vec3 nearest(const Vec3& n, const std::vector<oracle::OptimalNormal>& normals) {
  return std::min_element(normals.begin(), normals.end(),
                          [&](const auto& l, const auto& r) {
                            return angle_between(n, l.n) < angle_between(n, r.n);
                          })
      ->n;
}

double worst_point_error(const ts_answer& answer, const Configuration& c) {
  double worst = 0;
  for (int i = 0; i < answer.point_count; ++i) {
    worst = std::max(worst, point_outside(c, answer.points[i]));
  }
  return worst;
}

struct Depths {
  double min, max;
};
/// Extreme depths of the points. Precondition: there is one.
Depths depths_of(const ts_answer& answer) {
  const auto [min, max] =
      std::minmax_element(answer.points, answer.points + answer.point_count,
                          [](const ts_point& p, const ts_point& q) { return p.depth < q.depth; });
  return {min->depth, max->depth};
}

/// Outcome of an answer with the right depth and normal. `distance`, and `beyond`, by which the
/// farthest point is beyond the threshold, are relative to the smaller size. Separate bodies need
/// no point.
Outcome outcome_of_points(const Score& s, double distance, double beyond, const Bar& bar) {
  if (s.points == 0) {
    return distance <= bar.tolerance ? Outcome::no_points : Outcome::agree;
  }
  if (*s.deepest_error < -bar.tolerance) return Outcome::shallow_points;
  if (*s.deepest_error > bar.tolerance) return Outcome::overdeep_points;
  if (beyond > bar.tolerance) return Outcome::phantom_points;
  return *s.point_error > bar.tolerance ? Outcome::off_body : Outcome::agree;
}

Score only(Outcome outcome) {
  Score s;
  s.outcome = outcome;
  return s;
}

/// An error relative to a size. One that overflows is the largest double: it is finite, as are all
/// numbers of an answer that is scored, and reports are written in JSON, which knows no infinity.
double relative(double error, double size) {
  constexpr double max = std::numeric_limits<double>::max();
  return std::clamp(error / size, -max, max);
}

/// `resolved`: the overlap that doubles tell from a touch, relative as the distance is.
Score without_contact(double distance, double resolved, const Bar& bar) {
  Score s;
  if (distance < -bar.tolerance) {
    s.outcome = Outcome::missed;
    s.severity = -distance;
  } else if (distance < -resolved) {
    s.outcome = Outcome::unseen;
  }
  return s;
}

}  // namespace

Vec3 patch_normal(const oracle::Truth& truth, const Vec3& n) {
  constexpr double far = 1;  // degrees
  const Vec3 listed = nearest(n, truth.normals);
  return truth.ties == oracle::Ties::continuum && angle_between(n, listed) > far ? n.normalized()
                                                                                 : listed;
}

bool is_finite(const ts_answer& answer) {
  if (!std::isfinite(answer.signed_distance) || !vector(answer.normal).allFinite()) return false;
  return std::all_of(answer.points, answer.points + answer.point_count, [](const ts_point& p) {
    return std::isfinite(p.depth) && vector(p.position).allFinite() && vector(p.normal).allFinite();
  });
}

namespace {

struct OutcomeKind {
  Outcome outcome;
  const char* name;
  bool is_judged = true;
  bool is_of_points = false;
};
/// In the order of Outcome.
constexpr OutcomeKind kinds[] = {{Outcome::agree, "agree"},
                                 {Outcome::missed, "missed"},
                                 {Outcome::phantom, "phantom"},
                                 {Outcome::shallow, "shallow"},
                                 {Outcome::overdeep, "overdeep"},
                                 {Outcome::wrong_normal, "wrong-normal"},
                                 {Outcome::not_finite, "not-finite", false},
                                 {Outcome::failed, "failed", false},
                                 {Outcome::crashed, "crashed", false},
                                 {Outcome::timed_out, "timed-out", false},
                                 {Outcome::unsupported, "unsupported", false},
                                 {Outcome::shallow_points, "shallow-points", true, true},
                                 {Outcome::overdeep_points, "overdeep-points", true, true},
                                 {Outcome::phantom_points, "phantom-points", true, true},
                                 {Outcome::not_asked, "not-asked", false},
                                 {Outcome::off_body, "off-body", true, true},
                                 {Outcome::no_points, "no-points", true, true},
                                 {Outcome::unseen, "unseen"}};
static_assert(std::equal(std::begin(kinds), std::end(kinds), all_outcomes.begin(),
                         all_outcomes.end(), [](const OutcomeKind& kind, Outcome outcome) {
                           return kind.outcome == outcome;
                         }));

const OutcomeKind& kind_of(Outcome outcome) { return kinds[static_cast<std::size_t>(outcome)]; }

}  // namespace

const char* outcome_name(Outcome outcome) { return kind_of(outcome).name; }
bool is_judged(Outcome outcome) { return kind_of(outcome).is_judged; }
bool is_of_points(Outcome outcome) { return kind_of(outcome).is_of_points; }

bool agrees(Outcome outcome) { return outcome == Outcome::agree || outcome == Outcome::unseen; }

const char* status_name(ts_status status) {
  switch (status) {
    case TS_CONTACT:
      return "contact";
    case TS_NONE:
      return "none";
    case TS_UNSUPPORTED:
      return "unsupported";
    case TS_FAILED:
      return "failed";
    case TS_CRASHED:
      return "crashed";
    case TS_TIMED_OUT:
      return "timed-out";
  }
  return "failed";
}

namespace {

/// The larger size, or over a plane the distance of the origins if that is more.
double largest_length(const Configuration& c) {
  double largest = larger_size(c);
  if (const auto* plane = std::get_if<Plane>(&c.b)) {
    const double aside = (c.pose_a.position() - c.pose_b.position()).cwiseAbs().maxCoeff();
    largest = std::max({largest, aside, std::abs(plane->unit_displacement())});
  }
  return largest;
}

/// What doubles resolve, relative to the largest length.
constexpr double resolved = 1e-13;

}  // namespace

double error_size(const Configuration& c, const Bar& bar) {
  return std::max(smaller_size(c), std::min(1.0, resolved / bar.tolerance) * largest_length(c));
}

namespace {

/// The patch along one normal, which answers with that normal nearest to theirs share.
struct NormalPatch {
  Vec3 normal;
  /// Most poses: the patch is a corner, which any point covers.
  bool is_a_corner;
  double resolution = 0;              ///< metres, for coverage
  std::optional<PatchExtent> extent;  ///< unless it is a corner
};

/// Zeros of either sign differ: a patch's axes may depend on the sign.
bool same_bits(const Vec3& n, const Vec3& m) {
  using Bits = std::array<std::uint64_t, 3>;
  const auto bits = [](const Vec3& v) {
    return std::bit_cast<Bits>(std::array{v.x(), v.y(), v.z()});
  };
  return bits(n) == bits(m);
}

NormalPatch patch_along(const Configuration& c, const Vec3& n) {
  const double size = smaller_size(c), depth = patch_depth * size;
  const auto of_a = oracle::width_from_epsilon(c.a, c.pose_a, n, depth);
  const auto of_b = oracle::width_from_epsilon(c.b, c.pose_b, n, depth);
  NormalPatch result{n, of_a.is_a_corner || of_b.is_a_corner, 0, {}};
  if (result.is_a_corner) return result;
  // 1% more than the width itself, so that rounding does not decide.
  result.resolution = std::max({patch_resolution * size, 1.01 * of_a.largest, 1.01 * of_b.largest});
  result.extent.emplace(oracle::contact_patch(c, n, depth));
  return result;
}

/// Of the distance of bodies that a candidate has rounded: below what doubles resolve.
constexpr double model_width = 1e-17;

}  // namespace

struct Judge::State {
  const Configuration& c;
  const oracle::Truth& truth;
  const Bar bar;
  const double size;         ///< to which errors are relative, metres
  const double true_metres;  ///< true signed distance
  const double distance;     ///< the same, relative to `size`
  std::optional<oracle::Regrets> regrets;
  std::vector<NormalPatch> patches;
  /// Of the bodies rounded by candidates, metres.
  struct Rounded {
    std::array<double, 2> roundings;
    std::optional<double> distance;
  };
  std::vector<Rounded> rounded;

  /// None if no such bodies exist.
  std::optional<double> rounded_distance(const std::array<double, 2>& roundings) {
    for (const Rounded& known : rounded) {
      if (known.roundings == roundings) return known.distance;
    }
    std::optional<double> distance;
    try {
      const Shape a = with_rounding(c.a, roundings[0]), b = with_rounding(c.b, roundings[1]);
      const Configuration model{std::get<Cylinder>(a), c.pose_a, b, c.pose_b};
      distance = oracle::truth(model, model_width).signed_distance.midpoint();
    } catch (const InvalidInput&) {
    }
    return rounded.emplace_back(Rounded{roundings, distance}).distance;
  }

  std::optional<double> model_distance(const Answer& answer) {
    return answer.roundings ? rounded_distance(*answer.roundings) : answer.model_distance;
  }

  /// Against the whole bodies, metres.
  double whole_regret(const Vec3& n) {
    if (!regrets) regrets.emplace(c, truth);
    return regrets->of(n);
  }

  const NormalPatch& patch(const Vec3& n) {
    for (const NormalPatch& known : patches) {
      if (same_bits(known.normal, n)) return known;
    }
    return patches.emplace_back(patch_along(c, n));
  }

  double coverage_by(const ts_answer& answer) {
    const NormalPatch& p = patch(patch_normal(truth, vector(answer.normal)));
    if (p.is_a_corner) return answer.point_count > 0 ? 1 : 0;
    std::vector<Vec3> points;
    points.reserve(static_cast<std::size_t>(answer.point_count));
    for (int i = 0; i < answer.point_count; ++i) {
      points.push_back(vector(answer.points[i].position));
    }
    return coverage(*p.extent, points, p.resolution);
  }

  Score of_contact(const ts_answer& answer);
};

Judge::Judge(const Configuration& c, const oracle::Truth& truth, const Bar& bar) {
  const double size = error_size(c, bar);
  const double metres = truth.signed_distance.midpoint();
  state_ = std::make_unique<State>(
      State{c, truth, bar, size, metres, relative(metres, size), {}, {}, {}});
}
Judge::Judge(Judge&&) noexcept = default;
Judge::~Judge() = default;

Score Judge::State::of_contact(const ts_answer& answer) {
  Score s;
  s.points = answer.point_count;
  const Vec3 n = vector(answer.normal);
  const bool unit = std::abs(n.norm() - 1) <= unit_slack;
  s.depth_error = relative(answer.signed_distance - true_metres, size);
  s.severity = std::abs(*s.depth_error);
  double beyond = 0;
  if (answer.point_count > 0) {
    const Depths depths = depths_of(answer);
    s.point_error = relative(worst_point_error(answer, c), size);
    s.deepest_error = relative(depths.max + true_metres, size);
    s.severity = std::max(s.severity, std::abs(*s.deepest_error));
    beyond = relative(-depths.min - bar.threshold, size);
  }
  if (!n.isZero(0)) {
    const double whole = whole_regret(n);
    s.whole_regret = relative(whole, size);
    s.normal_regret = relative(felt_regret(c, truth, n.normalized(), whole), size);
    s.normal_angle = angle_to_optimal(c, truth, n, whole);
    s.severity = std::max(s.severity, *s.normal_regret);
  }
  if (distance > bar.threshold / size + bar.tolerance) {
    s.outcome = Outcome::phantom;
  } else if (*s.depth_error > bar.tolerance) {
    s.outcome = Outcome::shallow;
  } else if (*s.depth_error < -bar.tolerance) {
    s.outcome = Outcome::overdeep;
  } else if (!unit || !s.normal_regret || *s.normal_regret > bar.tolerance) {
    s.outcome = Outcome::wrong_normal;
  } else {
    s.outcome = outcome_of_points(s, distance, beyond, bar);
    if (s.points == 0) s.severity = std::max(s.severity, -distance);
    if (s.outcome == Outcome::phantom_points) s.severity = std::max(s.severity, beyond);
    if (s.outcome == Outcome::off_body) s.severity = std::max(s.severity, *s.point_error);
  }
  const bool right_normal = unit && s.normal_regret && *s.normal_regret <= bar.tolerance;
  if (s.outcome != Outcome::phantom && right_normal) s.coverage = coverage_by(answer);
  return s;
}

Score Judge::score(const ts_answer& answer) {
  switch (answer.status) {
    case TS_NONE:
      return without_contact(state_->distance,
                             relative(resolved * largest_length(state_->c), state_->size),
                             state_->bar);
    case TS_CONTACT:
      return is_finite(answer) ? state_->of_contact(answer) : only(Outcome::not_finite);
    case TS_UNSUPPORTED:
      return only(Outcome::unsupported);
    case TS_CRASHED:
      return only(Outcome::crashed);
    case TS_TIMED_OUT:
      return only(Outcome::timed_out);
    default:
      return only(Outcome::failed);
  }
}

Score Judge::score(const Answer& answer) {
  if (!answer.was_asked) return only(Outcome::not_asked);
  Score s = score(static_cast<const ts_answer&>(answer));
  if (!s.depth_error && s.outcome != Outcome::missed) return s;
  if (const auto distance = state_->model_distance(answer)) {
    // A miss says that the model is apart, or that it touches.
    const double answered = s.depth_error ? answer.signed_distance : std::max(*distance, 0.0);
    s.model_error = relative(*distance - state_->true_metres, state_->size);
    s.solver_error = relative(answered - *distance, state_->size);
  }
  return s;
}

Score score(const Configuration& c, const oracle::Truth& truth, const ts_answer& answer,
            const Bar& bar) {
  return Judge(c, truth, bar).score(answer);
}

Score score(const Configuration& c, const oracle::Truth& truth, const Answer& answer,
            const Bar& bar) {
  return Judge(c, truth, bar).score(answer);
}

}  // namespace touchstone
