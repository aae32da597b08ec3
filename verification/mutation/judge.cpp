#include "verification/mutation/judge.hpp"

#include <limits>

namespace touchstone::mutation {
namespace {

constexpr Real promised = 1e-13L;
/// The part of all lengths together that a bound of the error is at most, which is rounding alone
/// (lengths are counted in a turned frame).
/// Twice the rounding that is derived in reference/proofs.md: the least one, and as much of proofs.
constexpr Real max_error_part = 1.43e-14L;

Numbers3 negated(const Numbers3& v) { return {-v[0], -v[1], -v[2]}; }

bool is_unit(const Numbers3& n) {
  constexpr Real unit = 1e-14L;
  return std::abs(vector(n).norm() - 1) <= unit;  // false of NaN
}

Real dot(const Numbers3& a, const Numbers3& b) { return vector(a).dot(vector(b)); }

/// All that is asked of one configuration.
class Judge {
 public:
  Judge(const Case& c, const Routines& routines)
      : case_(c),
        routines_(routines),
        geometry_(c.raw),
        sigma_(c.signed_distance),
        smaller_(geometry_.smaller_size()),
        larger_(geometry_.larger_size()) {
    const Real apart = (geometry_.position_a - geometry_.position_b).cwiseAbs().maxCoeff();
    tolerance_ =
        promised * std::max({larger_, apart, std::abs(geometry_.displacement), geometry_.far});
    // A point's own coordinates are rounded.
    const Real places =
        std::max(geometry_.position_a.norm(), geometry_.position_b.norm()) + larger_;
    point_tolerance_ = 10 * tolerance_ + 4e-15L * places;
  }

  Findings findings() {
    const char* field = nullptr;
    made_ = routines_.make(case_.raw, &field);
    if (!made_) {
      fail(Check::refusal, 0);
      return findings_;
    }
    judge_distance();
    judge_certified();
    judge_bounds();
    judge_contacts();
    judge_hints();
    judge_steadiness();
    if (geometry_.pair == cylinder) judge_exchange();
    judge_batches(case_, made_, routines_,
                  [&](bool holds, Check check, int variant) { expect(holds, check, variant); });
    routines_.release(made_);
    return findings_;
  }

 private:
  void fail(Check check, int variant) {
    findings_.set(static_cast<std::size_t>(check) * max_variants +
                  static_cast<std::size_t>(variant));
  }
  void expect(bool holds, Check check, int variant = 0) {
    if (!holds) fail(check, variant);
  }

  Real regret(const Numbers3& n) const {
    if (geometry_.pair == plane) return larger_ * (vector(n) - geometry_.plane_normal).norm();
    return sigma_ - geometry_.gap(vector(n).normalized());
  }

  void judge_distance() {
    const RawDistance found = routines_.signed_distance(made_);
    distance_ = found.value;
    expect(std::isfinite(found.value) && is_unit(found.normal), Check::finite);
    expect(std::abs(found.value - sigma_) <= tolerance_, Check::distance);
    expect(regret(found.normal) <= tolerance_, Check::regret);
    const bool overlaps = routines_.overlaps(made_);
    expect(overlaps == (found.value <= 0), Check::overlaps, 0);
    expect(overlaps == (sigma_ <= 0) || std::abs(sigma_) <= tolerance_, Check::overlaps, 1);
  }

  void judge_certified() {
    const RawDistance found = routines_.certified_distance(made_);
    expect(std::isfinite(found.value) && is_unit(found.normal), Check::finite, 1);
    expect(std::abs(found.value - sigma_) <= found.error_bound, Check::certified, 0);
    expect(regret(found.normal) <= found.error_bound + tolerance_, Check::certified, 1);
    expect(found.error_bound <= max_error_part * geometry_.lengths(), Check::certified, 2);
    // A bound that is less than an ulp or two of the lengths would be luck.
    expect(found.error_bound >= 4e-16L * larger_, Check::certified, 3);
    if (geometry_.pair != cylinder) return;
    const std::size_t index = std::hash<std::string>()(case_.identity);
    judge_arcs(made_, routines_, index, [&](bool holds, ArcCheck check) {
      expect(holds, Check::certified, 4 + static_cast<int>(check));
    });
  }

  void judge_bounds() {
    RawBounds a, b;
    routines_.bounds(made_, a, b);
    bool apart = false;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Vector e = Vector::Unit(i);
      const auto fits = [&](const RawBounds& found, Real place, Real reach, int variant) {
        const Real rounding = 8e-16L * (larger_ + std::abs(place));
        expect(std::abs(found.lower[k] - (place - reach)) <= rounding &&
                   std::abs(found.upper[k] - (place + reach)) <= rounding,
               Check::bounds, variant);
      };
      fits(a, geometry_.position_a[i], geometry_.reach_of_a(e), 0);
      if (geometry_.pair != plane) fits(b, geometry_.position_b[i], geometry_.reach_of_b(e), 1);
      apart = apart || a.lower[k] > b.upper[k] || b.lower[k] > a.upper[k];
    }
    if (geometry_.pair == plane) judge_bounds_of_plane(b);
    expect(routines_.bounds_overlap(made_) == !apart, Check::bounds, 2);
  }
  /// Bounded on the side of a normal that lies along an axis of the world.
  void judge_bounds_of_plane(const RawBounds& found) {
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Real along = geometry_.plane_normal[i];
      const Real face = geometry_.position_b[i] + along * geometry_.displacement;
      const Real rounding = 8e-16L * (std::abs(face) + std::abs(geometry_.position_b[i]));
      const bool flat = std::abs(along) == 1;
      expect(flat && along > 0 ? std::abs(found.upper[k] - face) <= rounding
                               : std::isinf(found.upper[k]) && found.upper[k] > 0,
             Check::bounds, 3);
      expect(flat && along < 0 ? std::abs(found.lower[k] - face) <= rounding
                               : std::isinf(found.lower[k]) && found.lower[k] < 0,
             Check::bounds, 4);
    }
  }

  void judge_contacts() {
    const auto smaller = static_cast<double>(smaller_), larger = static_cast<double>(larger_);
    const double thresholds[] = {0,
                                 0.01 * smaller,
                                 10 * larger,
                                 distance_,
                                 1e-6 * smaller,
                                 0.1 * smaller,
                                 -0.01 * smaller,
                                 distance_ / 2};
    int variant = 0;
    for (const double threshold : thresholds) {
      const RawContact answer = routines_.contact(made_, threshold, nullptr);
      judge_contact(answer, threshold, variant);
      if (variant < 2 || threshold == distance_) judge_coverage(answer, variant);
      ++variant;
    }
  }

  void judge_contact(const RawContact& answer, double threshold, int variant) {
    expect(std::isfinite(answer.signed_distance) && is_unit(answer.normal), Check::threshold,
           variant);
    expect((answer.count == 0) == !(distance_ <= threshold), Check::threshold, variant);
    if (answer.count == 0) {
      expect(answer.signed_distance > threshold && answer.signed_distance <= sigma_ + tolerance_,
             Check::clearance, variant);
      const Real along = geometry_.gap(vector(answer.normal).normalized());
      expect(std::abs(along - answer.signed_distance) <= tolerance_, Check::clearance, variant);
      return;
    }
    expect(std::abs(answer.signed_distance - sigma_) <= tolerance_, Check::distance,
           1 + variant % (max_variants - 1));
    expect(regret(answer.normal) <= tolerance_, Check::regret, 1 + variant % (max_variants - 1));
    judge_points(answer, threshold, variant);
  }

  void judge_points(const RawContact& answer, double threshold, int variant) {
    const Real depth = -static_cast<Real>(answer.signed_distance);
    Real deepest = -std::numeric_limits<Real>::infinity();
    const Vector half = vector(answer.normal) / 2;
    const Real slack = std::min(1e-3L * larger_, std::max<Real>(0, threshold + depth));
    // Where a round body leans, points beside its deepest one are seen at a slant, which moves them
    // into it by up to the square of the angle.
    const Real aside = point_tolerance_ + 50 * slack * slack / larger_;
    for (std::size_t i = 0; i < answer.count; ++i) {
      const RawPoint& p = answer.points[i];
      const Vector x = vector(p.position);
      deepest = std::max<Real>(deepest, p.depth);
      expect(p.depth <= depth + point_tolerance_, Check::points, variant);
      expect(p.depth >= -threshold - point_tolerance_, Check::points, variant);
      const Vector on_a = x - p.depth * half, on_b = x + p.depth * half;
      expect(std::abs(geometry_.outside_a(on_a)) <= aside, Check::surfaces, variant);
      expect(std::abs(geometry_.outside_b(on_b)) <= aside, Check::surfaces, variant);
      // No point where a round side has turned away: the manifold's is at most asin(3/4).
      constexpr Real turned_away = 0.6L;
      if (smaller_ < 100 * point_tolerance_) continue;  // rounding says where on a body it lies
      expect(geometry_.facing_a(on_a, -2 * half) >= turned_away, Check::surfaces, variant);
      expect(geometry_.facing_b(on_b, 2 * half) >= turned_away, Check::surfaces, variant);
    }
    expect(deepest >= depth - 1e-6L * smaller_ - point_tolerance_, Check::points, variant);
  }

  /// The hull's reach from the patch's centroid, relative to the patch's own, where it is least.
  void judge_coverage(const RawContact& answer, int variant) {
    if (answer.count == 0) return;
    for (const KnownPatch& patch : case_.patches) {
      constexpr Real same = 1e-9L;
      const bool leans = patch.leans != 0;
      const Real bar = leans ? 0.3L : 0.45L;
      if (leans && variant != 1) continue;  // that of leaning_threshold
      const Vector n = vector(answer.normal);
      if ((vector(patch.normal) - n).norm() > same) continue;
      Vector centre = Vector::Zero();
      for (const Numbers3& x : patch.outline) centre += vector(x) / patch.outline.size();
      centre = centroid(patch, centre, n);
      const Vector e = n.unitOrthogonal(), f = n.cross(e);
      constexpr int directions = 64;
      for (int i = 0; i < directions; ++i) {
        const Real angle = 6.283185307179586L * i / directions;
        const Vector u = std::cos(angle) * e + std::sin(angle) * f;
        Real of_patch = 0, behind = 0, of_points = -std::numeric_limits<Real>::infinity();
        for (const Numbers3& x : patch.outline) {
          of_patch = std::max(of_patch, (vector(x) - centre).dot(u));
          behind = std::max(behind, (centre - vector(x)).dot(u));
        }
        for (std::size_t k = 0; k < answer.count; ++k) {
          of_points = std::max(of_points, (vector(answer.points[k].position) - centre).dot(u));
        }
        if (of_patch + behind < 0.1L * smaller_) continue;  // thin: as good as a line
        expect(of_points >= bar * of_patch, Check::coverage, leans ? 2 : variant);
      }
    }
  }
  /// Centroid of the patch: of a polygon by triangles about `inside`, of a segment its middle.
  static Vector centroid(const KnownPatch& patch, const Vector& inside, const Vector& n) {
    Real area = 0;
    Vector moment = Vector::Zero();
    for (std::size_t i = 0; i < patch.outline.size(); ++i) {
      const Vector p = vector(patch.outline[i]) - inside;
      const Vector q = vector(patch.outline[(i + 1) % patch.outline.size()]) - inside;
      const Real twice = p.cross(q).dot(n);
      area += twice;
      moment += twice / 3 * (p + q);
    }
    return patch.outline.size() > 2 && area != 0 ? Vector(inside + moment / area) : inside;
  }

  /// Hints: the optimal normals, their opposites, and one that has nothing to do with the bodies.
  void judge_hints() {
    const double threshold = static_cast<double>(0.01L * smaller_);
    const RawContact plain = routines_.contact(made_, threshold, nullptr);
    std::vector<Numbers3> hints = {{0, 0.6, 0.8}, {-0.8, 0.6, 0}};
    const std::size_t unrelated = hints.size();
    hints.push_back(negated(plain.normal));
    hints.insert(hints.end(), case_.normals.begin(), case_.normals.end());
    for (std::size_t i = 0; i < hints.size() && i < max_variants; ++i) {
      const int variant = static_cast<int>(i);
      const RawContact hinted = routines_.contact(made_, threshold, &hints[i]);
      expect((hinted.count == 0) == (plain.count == 0), Check::hint, variant);
      if (hinted.count == 0) continue;
      expect(is_unit(hinted.normal), Check::hint, variant);
      const Real along = geometry_.gap(vector(hinted.normal).normalized());
      expect(std::abs(hinted.signed_distance - along) <= tolerance_, Check::hint, variant);
      expect(sigma_ - along <= threshold + tolerance_, Check::hint, variant);
      expect(dot(hinted.normal, hints[i]) >= dot(plain.normal, hints[i]) - 1e-14L, Check::hint,
             variant);
      if (i > unrelated) {  // a normal that is optimal is kept, but for what is nearer still
        constexpr Real cosine_of_5_degrees = 0.9961L;
        expect(dot(hinted.normal, hints[i]) >= cosine_of_5_degrees, Check::hint, variant);
        Real deepest = -std::numeric_limits<Real>::infinity();
        for (std::size_t k = 0; k < hinted.count; ++k) {
          deepest = std::max<Real>(deepest, hinted.points[k].depth);
        }
        expect(deepest >= -along - 1e-6L * smaller_ - point_tolerance_, Check::hint, variant);
      }
    }
  }

  /// A turned and moved by a millionth of what anybody sees.
  void judge_steadiness() {
    constexpr double angles[] = {1e-10, 1e-8};
    const double threshold = static_cast<double>(0.01L * smaller_);
    const RawContact before = routines_.contact(made_, threshold, nullptr);
    for (int variant = 0; variant < 2; ++variant) {
      RawConfiguration moved = case_.raw;
      const double half = angles[variant] / 2;
      const auto [w, x, y, z] = moved.orientation_a;
      moved.orientation_a = {w - half * x + half * y, x + half * w + half * z,
                             y + half * z - half * w, z - half * y - half * x};
      const double step = angles[variant] * static_cast<double>(smaller_);
      for (double& coordinate : moved.position_a) coordinate += 0.5 * step;
      const char* field = nullptr;
      const void* made = routines_.make(moved, &field);
      if (!made) return fail(Check::steadiness, variant);
      const RawContact after = routines_.contact(made, threshold, nullptr);
      routines_.release(made);
      const Real far = 1e-5L * larger_ + 1e3L * angles[variant] * larger_;
      // Of normals that all but tie another one may have come to be the best.
      constexpr Real same = 1e-6L;
      if ((vector(after.normal) - vector(before.normal)).norm() > same) continue;
      expect(after.count == before.count, Check::steadiness, variant);
      for (std::size_t i = 0; i < std::min(after.count, before.count); ++i) {
        const Vector way = vector(after.points[i].position) - vector(before.points[i].position);
        expect(way.norm() <= far, Check::steadiness, variant);
      }
    }
  }

  void judge_exchange() {
    RawConfiguration raw = case_.raw;
    std::swap(raw.sizes[0], raw.sizes[2]), std::swap(raw.sizes[1], raw.sizes[3]);
    raw = with_poses_exchanged(raw);
    const char* field = nullptr;
    const void* other = routines_.make(raw, &field);
    if (!other) return fail(Check::exchange, 0);
    const RawDistance one = routines_.signed_distance(made_);
    const RawDistance two = routines_.signed_distance(other);
    expect(one.value == two.value && one.normal == negated(two.normal), Check::exchange, 0);
    expect(routines_.overlaps(made_) == routines_.overlaps(other), Check::exchange, 1);
    const double threshold = static_cast<double>(0.01L * smaller_);
    const RawContact first = routines_.contact(made_, threshold, nullptr);
    const RawContact second = routines_.contact(other, threshold, nullptr);
    bool same = first.count == second.count && first.normal == negated(second.normal) &&
                first.signed_distance == second.signed_distance;
    for (std::size_t i = 0; same && i < first.count; ++i) {
      same = first.points[i].position == second.points[i].position &&
             first.points[i].depth == second.points[i].depth;
    }
    expect(same, Check::exchange, 2);
    const RawDistance sure = routines_.certified_distance(other);
    expect(std::abs(sure.value - sigma_) <= sure.error_bound, Check::exchange, 3);
    routines_.release(other);
  }

  const Case& case_;
  const Routines& routines_;
  const Geometry geometry_;
  Real sigma_, smaller_, larger_, tolerance_, point_tolerance_;
  const void* made_ = nullptr;
  double distance_ = 0;
  Findings findings_;
};

}  // namespace

const char* check_name(int check) {
  static const char* const names[check_count] = {
      "finite",    "distance", "regret",    "certified", "overlaps",   "threshold",
      "clearance", "points",   "surfaces",  "coverage",  "steadiness", "hint",
      "exchange",  "bounds",   "agreement", "refusal",   "batch",      "in-float"};
  return names[check];
}

Findings judge(const Case& c, const Routines& routines) { return Judge(c, routines).findings(); }

Findings judge_agreement(const Case& c, const Routines& routines) {
  Findings findings;
  const char* field = nullptr;
  const void* made = routines.make(c.raw, &field);
  const auto expect = [&](bool holds, std::size_t variant) {
    if (!holds) findings.set(static_cast<std::size_t>(Check::agreement) * max_variants + variant);
  };
  expect(made != nullptr, 0);
  if (!made) return findings;
  const Geometry geometry(c.raw);
  const RawDistance found = routines.signed_distance(made);
  const RawDistance certified = routines.certified_distance(made);
  const Real tolerance = promised * geometry.lengths();
  expect(std::abs(found.value - static_cast<Real>(certified.value)) <=
             tolerance + certified.error_bound,
         1);
  // What overflows is the largest double.
  constexpr Real max_length = std::numeric_limits<double>::max();
  const Real along = geometry.gap(vector(found.normal).normalized());
  expect(std::abs(std::clamp(along, -max_length, max_length) - found.value) <= tolerance, 2);
  expect(routines.overlaps(made) == (found.value <= 0), 3);
  if (!(certified.error_bound <= max_error_part * geometry.lengths())) {
    findings.set(static_cast<std::size_t>(Check::certified) * max_variants + 2);
  }
  routines.release(made);
  return findings;
}

}  // namespace touchstone::mutation
