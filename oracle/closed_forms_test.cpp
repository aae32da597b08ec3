// Signed distances known on paper, by the truth, the second oracle and the certificates: three
// searches that share nothing.
#include <cmath>
#include <gtest/gtest.h>
#include <string>

#include "oracle/audit/certificate.hpp"
#include "oracle/audit/enclose.hpp"
#include "oracle/truth.hpp"
#include "properties/moves.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using Quaternion = Eigen::Quaterniond;
using oracle::Ties;

/// Turns by arctan(24/7) about y, exactly, since only the ratio of an integer quaternion's entries
/// matters: sine 24/25, cosine 7/25.
const Quaternion tilted_7_24(4, 0, 3, 0);

struct ClosedForm {
  const char* name;
  Configuration c;
  mpq_class distance;
  Ties ties = Ties::unique;
  Vec3 normal = Vec3::Zero();  ///< where it is looked at
};

const Cylinder can(1, 1), long_can(1, 5), thin(0.5, 5);
const double largest = 1.7e308, least = 5e-324;

const ClosedForm closed_forms[] = {
    // 3 − 2·7/25 − 1·24/25
    {"TiltedOverAPlaneTheRimsHeight",
     {Cylinder(1, 2), Pose({0, 0, 3}, tilted_7_24), Plane({0, 0, 2}, 0), Pose()},
     {37, 25},
     Ties::unique,
     {0, 0, 1}},
    // 4 z <= 6 after a shift of the plane's frame by 1/2 along z: z <= 2.
    {"APlaneIsTheHalfSpaceWhateverItsNormalsLength",
     {can, Pose({5, 6, 4}, upright), Plane({0, 0, 4}, 6), Pose({7, 8, 0.5}, upright)},
     1},
    {"WithinAPlane",
     {can, Pose({5, 6, 2.5}, upright), Plane({0, 0, 4}, 6), Pose({7, 8, 0.5}, upright)},
     {-1, 2}},
    {"APlaneFarFromItsOrigin",
     {can, Pose({0, 0, 1e300}, upright), Plane({0, 0, 1e-5}, 1e295), Pose()},
     mpq_class(1e300) - 1 - mpq_class(1e295) / mpq_class(1e-5)},
    {"APlaneBeyondAllDoubles",
     {Cylinder(1, 2), Pose({0, 0, -7}, upright), Plane({0, 0, -least}, 0.5), Pose()},
     7 - 2 - mpq_class(0.5) / mpq_class(least)},
    // 3-4-5 from the rim point (1, 0, 1), less the radius.
    {"ASphereOutsideTheRim",
     {can, Pose(), Sphere(2), Pose({4, 0, 5}, upright)},
     3,
     Ties::unique,
     {-0.6, 0, -0.8}},
    {"ASphereBelowACapIsAsDeepAsTheCapSays",
     {Cylinder(2, 1), Pose(), Sphere(0.5), Pose({0.5, 0, 0.75}, upright)},
     {-3, 4}},
    {"ASphereOnTheAxisTiesTheWholeCircle",
     {Cylinder(1, 8), Pose(), Sphere(0.5), Pose({0, 0, 1}, upright)},
     {-3, 2},
     Ties::continuum},
    {"ASphereInTheMiddleOfACoinTiesBothCaps",
     {Cylinder(4, 1), Pose(), Sphere(0.5), Pose()},
     {-3, 2},
     Ties::finite},
    // Across x the axes are 3-4-5 apart.
    {"ParallelCylindersSideBySide",
     {Cylinder(1, 2), Pose({3, 4, 1}, along_x), Cylinder(0.5, 1), Pose({3, 1, 5}, along_x)},
     {7, 2}},
    {"CrossedCylindersInside",
     {long_can, Pose({0, 0, 1.25}, along_x), thin, Pose({0, 0, 0}, along_y)},
     {-1, 4}},
    {"CrossedCylindersTouchExactly",
     {long_can, Pose({0, 0, 1.5}, along_x), thin, Pose({0, 0, 0}, along_y)},
     0,
     Ties::unique,
     {0, 0, 1}},
    {"ACapInsideAWiderOneByTheOverlapOfLengths",
     {can, Pose({0.25, 0, 2.75}, upright), Cylinder(2, 2), Pose()},
     {-1, 4}},
    // The segment's end (4, 0, 5) is 3-4-5 from the rim; the capsule points away.
    {"ACapsulesEndOverTheRim", {can, Pose(), Capsule(0.5, 1), Pose({4, 0, 6}, upright)}, {9, 2}},
    {"ACapsuleLongerThanAllDoubles",
     {can, Pose({1.75e308, 0, 0}, upright), Capsule(largest, largest), Pose()},
     mpq_class(1.75e308) - mpq_class(largest) - 1},
    // The box's edge at x = 3, y = 4 from the axis.
    {"ABoxesEdgeAgainstTheSide",
     {Cylinder(1, 3), Pose(), Box({1, 1, 1}), Pose({4, 5, 0}, upright)},
     4,
     Ties::unique,
     {-0.6, -0.8, 0}},
    {"ABoxesFaceInsideACap",
     {Cylinder(0.5, 1), Pose({0.1, 0.2, 1.875}, upright), Box({1, 1, 1}), Pose()},
     {-1, 8}},
    {"ACapTouchesABoxesFace", {can, Pose({0.25, 0, 2}, upright), Box({2, 2, 1}), Pose()}, 0},
};

class ClosedForms : public testing::TestWithParam<ClosedForm> {
 protected:
  const Configuration& c() const { return GetParam().c; }
  const mpq_class& exact() const { return GetParam().distance; }
  bool is_continuum() const { return GetParam().ties == Ties::continuum; }
  mpq_class times_size(double width) const {
    return mpq_class(width) * mpq_class(larger_size(c()));
  }
};

TEST_P(ClosedForms, AreEnclosedByTheTruthWithItsNormal) {
  const oracle::Truth t = oracle::truth(c());
  EXPECT_LE(t.signed_distance.lo, exact());
  EXPECT_GE(t.signed_distance.hi, exact());
  EXPECT_EQ(t.ties, GetParam().ties);
  if (t.ties == Ties::finite) {
    EXPECT_EQ(t.normals.size(), 2u);
  }
  if (!GetParam().normal.isZero()) {
    EXPECT_TRUE(t.normals.at(0).n.isApprox(GetParam().normal));
  }
}

TEST_P(ClosedForms, AreEnclosedByTheSecondOracleToTheWidthOfDoubles) {
  const audit::Enclosure e = audit::enclose(c(), {1e-9, 4000});
  const bool is_finite = std::isfinite(e.lo) && std::isfinite(e.hi);
  if (is_finite) {
    EXPECT_LE(mpq_class(e.lo), exact());
    EXPECT_GE(mpq_class(e.hi), exact());
  }
  EXPECT_LE(e.cells, 4000);
  // A plane's bounds are roundings of its distance; all radial normals together are a family.
  const bool is_far = abs(exact()) > times_size(1e6);
  if (!is_far) {
    EXPECT_LE(e.hi - e.lo, (is_continuum() ? 1e-3 : 1.0001e-9) * larger_size(c()));
  }
}

TEST_P(ClosedForms, AreProvenToTheWidthAskedFor) {
  for (const double width : {1e-30, 1e-60}) {
    const audit::Certificate proof = audit::certify(c(), {width, 4000});
    EXPECT_LE(proof.lo, exact());
    EXPECT_GE(proof.hi, exact());
    EXPECT_EQ(proof.pair.has_value(), exact() >= 0 || std::holds_alternative<Plane>(c().b));
    EXPECT_EQ(proof.pair.has_value(), proof.cells.empty());
    EXPECT_LE(proof.cells.size(), 4000u);
    // Only one that needs no more digits than the search has.
    const bool is_far = abs(exact()) > times_size(1e6);
    if (!is_far) {
      EXPECT_LE(proof.hi - proof.lo, times_size(is_continuum() ? 1e-2 : width));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, ClosedForms, testing::ValuesIn(closed_forms),
                         [](const auto& form) { return std::string(form.param.name); });

TEST(AllOracles, SurviveTheEndsOfTheDoubleRange) {
  const Configuration c{
      Cylinder(1e-300, 1e300), Pose({1e308, 0, 0}, Quaternion(1e-300, 1e300, 1, 0)),
      Box({5e-324, 1, 1e300}), Pose({-1e308, 1e-308, 0}, Quaternion(1, 1e-160, 0, 0))};
  EXPECT_GT(oracle::truth(c).signed_distance.lo, mpq_class(1e308));
  const audit::Enclosure e = audit::enclose(c);
  EXPECT_GT(e.lo, 1e308);
  EXPECT_LE(e.lo, e.hi);
  const audit::Certificate proof = audit::certify(c, {1e-30, 4000});
  EXPECT_GT(proof.lo, mpq_class(1e308));
  EXPECT_GE(proof.hi, proof.lo);
}

TEST(AllOracles, RefuseAWidthThatIsNone) {
  const Configuration c{can, Pose(), Sphere(1), Pose()};
  for (const double width : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(oracle::truth(c, width), InvalidInput);
    EXPECT_THROW(audit::enclose(c, {width, 100}), InvalidInput);
    EXPECT_THROW(audit::certify(c, {width, 100}), InvalidInput);
  }
}

}  // namespace
}  // namespace touchstone
