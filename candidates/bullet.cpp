// Bullet 3.24, compiled twice: in double precision (Debian's -float64 libraries) and in single.
//
// Calls        The narrow phase that a world runs: the dispatcher's algorithm for the pair
//              (btConvexConvexAlgorithm with GJK and EPA's btGjkEpaPenetrationDepthSolver;
//              btConvexPlaneCollisionAlgorithm for the plane), kept with the pair as a world keeps
//              it, then processCollision into its manifold.
// Shapes       btCylinderShapeZ, btCapsuleShapeZ, btSphereShape, btBoxShape, btStaticPlaneShape.
// Margin       bullet: as Bullet makes them, min(0.04, a tenth of the smallest half extent) on
//              cylinder and box, taken from the inside, which keeps the faces where they are and
//              rounds the edges; for capsule and sphere the radius is the margin.
//              bullet-margin-0: setMargin(0) on cylinder and box, for sharp edges.
//              bullet-hull:N: btConvexHullShape of the prism's corners with margin 0; Bullet's own
//              0.04 would be put around the hull.
// Conventions  m_normalWorldOnB points from B to A of the manifold; its order is checked. A point
//              is midway between Bullet's positions on A and on B.
// Threshold    Bullet also reports points up to its contact breaking threshold apart (0.02 at
//              most); those beyond ours are left out.
// History      The manifold is emptied before every query: one query gives one point for most
//              pairs. bullet-persistent is what a world has after some steps: the pose is queried
//              four times rocked by 1 mrad about the world's x and y axes, then as it is, and the
//              manifold's points, up to four, are refreshed as Bullet does; its time is that of all
//              five queries.
// Precision    Single precision is given the poses rounded to float, as an engine would hold them.
#include <memory>

#include "candidates/bullet_pair.hpp"
#include "candidates/candidate.h"
#include "candidates/model.hpp"

using touchstone::bullet::Setting;

struct ts_prepared {
  touchstone::bullet::Pair pair;
  std::unique_ptr<touchstone::ModelPair> model;  ///< of bullet-hull
};

namespace {

constexpr bool single_precision = sizeof(btScalar) == sizeof(float);

int supports(ts_shape_kind) { return 1; }

constexpr Setting usual, sharp{true, false}, rocked{false, true};

template <Setting setting>
ts_prepared* prepare(const ts_shape* a, const ts_shape* b, double threshold, double) {
  return new ts_prepared{{*a, *b, threshold, setting}, nullptr};
}

ts_prepared* prepare_hull(const ts_shape* a, const ts_shape* b, double threshold, double sides) {
  const int n = static_cast<int>(sides);
  const auto prism = [n](double radius, double half_length) {
    return touchstone::inscribed_prism(n, radius, half_length);
  };
  return new ts_prepared{{*a, *b, threshold, {true, false, n}},
                         std::make_unique<touchstone::ModelPair>(*a, *b, prism)};
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
           ts_answer* answer) {
  prepared->pair.query(*a, *b, *answer);
}

double hull_distance(ts_prepared* prepared, const ts_pose* a, const ts_pose* b) {
  return prepared->model->separation(*a, *b).distance;
}

void release(ts_prepared* prepared) { delete prepared; }

#define NAME(rest) (single_precision ? "bullet-float" rest : "bullet" rest)
#define SETTINGS(rest) (single_precision ? "single precision; " rest : "double precision; " rest)
#define CALLS \
  "the world's narrow phase (GJK/EPA, plane analytic); points midway between the two surfaces; "

const ts_parameter sides = {"number of sides", 3, 128, 16, 1, 0};

const ts_candidate candidates[] = {
    {NAME(""), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "one query with an empty manifold; default margins: edges of cylinder and box "
                    "rounded by min(0.04 m, a tenth of the smallest half extent)"),
     nullptr, nullptr, supports, prepare<usual>, query, release, nullptr},
    {NAME("-margin-0"), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "one query with an empty manifold; margin 0 on cylinder and box"), nullptr,
     nullptr, supports, prepare<sharp>, query, release, nullptr},
    {NAME("-persistent"), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "the manifold after five queries, four of them rocked by 1 mrad; default "
                    "margins; the time is that of all five"),
     nullptr, nullptr, supports, prepare<rocked>, query, release, nullptr},
    {NAME("-hull"), TOUCHSTONE_BULLET_VERSION,
     SETTINGS(CALLS "one query with an empty manifold; btConvexHullShape and box with margin 0"),
     "every cylinder as the regular prism with its corners on the rims", &sides, supports,
     prepare_hull, query, release, hull_distance}};

// The last two tell nothing new in single precision.
const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, single_precision ? 2 : 4, candidates};

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
