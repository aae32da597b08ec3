#include "oracle/truth.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>

#include "oracle/critical_direction.hpp"

namespace touchstone::oracle {
namespace {

/// Enough for every double configuration by a wide margin; beyond it something is wrong with us.
constexpr long first_bits = 64;
constexpr long last_bits = 1L << 16;

struct Survivor {
  std::unique_ptr<CriticalDirection> direction;
  std::vector<DirectionBound> bounds;
};

/// Ends of the largest gap, in units, as far as they are known.
struct Maximum {
  std::optional<mpq_class> lo, hi;
};

/// Largest lower and upper end over all bounds. A bound without a normal is an upper one only; one
/// that is not finite leaves the upper end open.
Maximum maximum(const std::vector<Survivor>& survivors) {
  Maximum result;
  bool open = false;
  for (const auto& survivor : survivors) {
    for (const auto& bound : survivor.bounds) {
      if (!bound.gap.is_finite()) {
        open = true;
        continue;
      }
      const mpq_class hi = bound.gap.upper();
      if (!result.hi || hi > *result.hi) result.hi = hi;
      if (!bound.normal) continue;
      const mpq_class lo = bound.gap.lower();
      if (!result.lo || lo > *result.lo) result.lo = lo;
    }
  }
  if (open) result.hi.reset();
  return result;
}

/// A direction whose every bound stays below the best lower end is no maximum.
void drop_losers(std::vector<Survivor>& survivors, const mpq_class& best) {
  std::erase_if(survivors, [&](Survivor& survivor) {
    std::erase_if(survivor.bounds, [&](const DirectionBound& bound) {
      return bound.gap.is_finite() && bound.gap.upper() < best;
    });
    return survivor.bounds.empty();
  });
}

Vec3 in_world(const Difference& difference, const BallVector& n) {
  // A double of each coordinate and one normalisation: within a few ulp.
  const WorkingPrecision precision(128);
  const auto coordinate = [&](int row) { return dot(to_balls(difference.world_rows[row]), n); };
  const BallVector world{coordinate(0), coordinate(1), coordinate(2)};
  const Ball length = norm(world);
  return Vec3((world.x / length).midpoint(), (world.y / length).midpoint(),
              (world.z / length).midpoint())
      .normalized();
}

void set_normals(const Difference& difference, const std::vector<Survivor>& survivors,
                 Truth& truth) {
  // Directions of two kinds may coincide; doubles this close are one normal.
  constexpr double same = 1e-9;
  bool continuum = false;
  for (const auto& survivor : survivors) {
    for (const auto& bound : survivor.bounds) {
      if (!bound.normal) continue;
      continuum = continuum || survivor.direction->of_a_continuum();
      const Vec3 n = in_world(difference, *bound.normal);
      const bool known = std::any_of(truth.normals.begin(), truth.normals.end(),
                                     [&](const Vec3& m) { return (m - n).norm() < same; });
      if (!known) truth.normals.push_back(n);
    }
  }
  // g is concave as a function of vectors of any length, so two normals of gap zero make the whole
  // arc between them optimal.
  const auto& [lo, hi] = truth.signed_distance;
  const bool touching = lo <= 0 && 0 <= hi;
  const bool several = truth.normals.size() > 1;
  truth.ties = continuum || (several && touching) ? Ties::continuum
               : several                          ? Ties::finite
                                                  : Ties::unique;
}

CriticalDirections critical_directions(const Difference& difference) {
  CriticalDirections directions;
  add_axial_directions(difference, directions);
  add_radial_directions(difference, directions);
  add_rim_vertex_directions(difference, directions);
  add_rim_line_directions(difference, directions);
  add_rim_rim_directions(difference, directions);
  return directions;
}

/// A half-space has one direction.
class PlaneDirection : public CriticalDirection {
 public:
  explicit PlaneDirection(IntegerVector normal) : normal_(std::move(normal)) {}
  void enclose(const BallDifference& difference, std::vector<DirectionBound>& out) override {
    const BallVector n = to_balls(normal_);
    out.push_back({difference.gap(n), n});
  }

 private:
  IntegerVector normal_;
};

}  // namespace

Truth truth(const Configuration& configuration, double width) {
  const Difference difference = make_difference(configuration);
  const mpq_class wanted = width_in_units(difference, configuration, width);

  CriticalDirections directions;
  if (difference.is_plane) {
    directions.push_back(std::make_unique<PlaneDirection>(difference.plane_normal));
  } else {
    directions = critical_directions(difference);
  }
  std::vector<Survivor> survivors;
  for (auto& direction : directions) survivors.push_back({std::move(direction), {}});

  for (long bits = first_bits; bits <= last_bits; bits *= 2) {
    const WorkingPrecision precision(bits);
    const BallDifference balls(difference);
    for (auto& survivor : survivors) {
      survivor.bounds.clear();
      survivor.direction->enclose(balls, survivor.bounds);
    }
    const Maximum best = maximum(survivors);
    if (!best.lo) continue;
    drop_losers(survivors, *best.lo);
    if (!best.hi || *best.hi - *best.lo > wanted) continue;

    Truth result;
    result.signed_distance = {*best.lo * difference.unit, *best.hi * difference.unit};
    set_normals(difference, survivors, result);
    return result;
  }
  throw std::logic_error("oracle: the signed distance could not be enclosed");
}

}  // namespace touchstone::oracle
