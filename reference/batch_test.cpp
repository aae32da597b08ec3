// A batch has the same bits as single pairs: in every pose class, hostile ones, at every distance
// and threshold, at every length of a batch. And the same in single precision.
#include "reference/batch.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/error_of_test.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/random_hulls_test.hpp"
#include "reference/single_precision.hpp"

namespace touchstone {
namespace {

struct Poses {
  std::vector<Pose> a, b;

  std::size_t size() const { return a.size(); }
  void add(const Pose& pose_a, const Pose& pose_b) { a.push_back(pose_a), b.push_back(pose_b); }
};

bool same_bits(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}
bool same_bits(const Vec3& x, const Vec3& y) {
  return same_bits(x.x(), y.x()) && same_bits(x.y(), y.y()) && same_bits(x.z(), y.z());
}
bool same_bits(const Contact& x, const Contact& y) {
  if (!same_bits(x.signed_distance, y.signed_distance) || !same_bits(x.normal, y.normal) ||
      x.points().size() != y.points().size()) {
    return false;
  }
  for (std::size_t i = 0; i < x.points().size(); ++i) {
    const ContactPoint &p = x.points()[i], &q = y.points()[i];
    if (!same_bits(p.position, q.position) || !same_bits(p.depth, q.depth)) return false;
  }
  return true;
}

/// Asks about all poses at once and one by one.
void expect_same_bits(const Cylinder& a, const Shape& b, const Poses& poses, double threshold,
                      PointRange range = PointRange::near_deepest) {
  const std::size_t count = poses.size();
  std::vector<SignedDistance> distances(count);
  signed_distance(a, poses.a, b, poses.b, distances);
  const auto overlap = std::make_unique<bool[]>(count);
  overlaps(a, poses.a, b, poses.b, std::span(overlap.get(), count));
  // Answers of before must not show through.
  std::vector<Contact> contacts(count);
  for (Contact& c : contacts) c.add_point(Vec3::Zero(), 0);
  contact(a, poses.a, b, poses.b, threshold, contacts, range);
  for (std::size_t i = 0; i < count; ++i) {
    const Configuration c{a, poses.a[i], b, poses.b[i]};
    const SignedDistance one = signed_distance(c);
    ASSERT_TRUE(same_bits(distances[i].value, one.value)) << i;
    ASSERT_TRUE(same_bits(distances[i].normal, one.normal)) << i;
    ASSERT_EQ(overlap[i], overlaps(c)) << i;
    ASSERT_TRUE(same_bits(contacts[i], contact(c, threshold, nullptr, range))) << i;
  }
}

/// As they are, and A moved along the normal from B to distances from deep inside to far apart,
/// `threshold` and its neighbours among them.
void add_distances(const Configuration& c, double threshold, Poses& poses) {
  const SignedDistance found = signed_distance(c);
  const double size = smaller_size(c);
  poses.add(c.pose_a, c.pose_b);
  for (const double distance :
       {-0.1 * size, 0.0, std::nextafter(threshold, 0), threshold, std::nextafter(threshold, size),
        1e-9 * size, 1e-3 * size, 0.1 * size, size, 100 * size}) {
    const Vec3 to = c.pose_a.position() + (distance - found.value) * found.normal;
    if (to.allFinite()) poses.add(Pose(to, c.pose_a.orientation()), c.pose_b);
  }
}

class Batch : public testing::TestWithParam<Pair> {};

TEST_P(Batch, HasTheBitsOfSinglePairsInEveryPoseClass) {
  std::vector<std::string> classes = pose_classes(GetParam());
  classes.push_back("hostile");
  for (const std::string& name : classes) {
    const std::uint64_t count = name == "hostile" ? 1000 : of_each_class(GetParam(), 10);
    for (std::uint64_t i = 0; i < count; ++i) {
      const Identity id{GetParam(), name, 5, i};
      SCOPED_TRACE(to_string(id));
      const Configuration c = make_configuration(id);
      const double threshold = (i % 3 == 0 ? 0 : i % 3 == 1 ? 0.05 : -0.01) * smaller_size(c);
      Poses poses;
      add_distances(c, threshold, poses);
      // These shapes in the poses of others of the class, and exchanged.
      for (std::uint64_t k = 0; k < 7; ++k) {
        const Configuration other = make_configuration({GetParam(), name, 6, k});
        poses.add(other.pose_a, other.pose_b);
        poses.add(other.pose_b, other.pose_a);
      }
      const auto range = i % 2 == 0 ? PointRange::near_deepest : PointRange::within_threshold;
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(c.a, c.b, poses, threshold, range));
    }
  }
}

TEST(BatchOfHulls, HasTheBitsOfSinglePairs) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Configuration c = with_hull(hull_kinds[i % std::size(hull_kinds)], random);
    const double threshold = (i % 3 == 0 ? 0 : i % 3 == 1 ? 0.05 : -0.01) * smaller_size(c);
    Poses poses;
    add_distances(c, threshold, poses);
    poses.add(c.pose_b, c.pose_a);
    const auto range = i % 2 == 0 ? PointRange::near_deepest : PointRange::within_threshold;
    ASSERT_NO_FATAL_FAILURE(expect_same_bits(c.a, c.b, poses, threshold, range)) << i;
  }
}

// Out of the range of plain arithmetic, and at its ends.
TEST_P(Batch, HasTheBitsOfSinglePairsAtEveryScale) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    const Configuration c = make_configuration({GetParam(), "general", 5, i});
    Poses poses;
    add_distances(c, 0, poses);
    for (const int exponent : {-900, -400, -83, 83, 400, 900}) {
      const Pose far(std::ldexp(1, exponent) * c.pose_a.position(), c.pose_a.orientation());
      poses.add(far, c.pose_b);
      poses.add(c.pose_a, far);
    }
    ASSERT_NO_FATAL_FAILURE(expect_same_bits(c.a, c.b, poses, 0));
    for (const double size : {1e-300, 1e-26, 1e-24, 1e24, 1e26, 1e300}) {
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(Cylinder(size, 1), c.b, poses, 0)) << size;
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(Cylinder(1, size), c.b, poses, size)) << size;
    }
  }
}

// Where two directions tie, an axis has zeros of either sign, or all of a direction vanishes.
TEST_P(Batch, HasTheBitsOfSinglePairsOnALattice) {
  const Configuration c = make_configuration({GetParam(), "general", 5, 0});
  Poses poses;
  const Eigen::Quaterniond turns[] = {{1, 0, 0, 0},  {0, 1, 0, 0}, {0, 0, -1, 0}, {1, 1, 0, 0},
                                      {1, 0, -1, 0}, {1, 1, 1, 1}, {1, -1, 0, 0}, {-0.0, 0, 0, 1}};
  for (const double x : {-2.0, -0.0, 2.0}) {
    for (const double y : {-3.0, 0.0, 3.0}) {
      for (const double z : {-4.0, 0.0, 1.0, 5.0}) {
        for (const auto& turn : turns) {
          poses.add(Pose({x, y, z}, turn), Pose());
          poses.add(Pose({x, y, z}, turn), Pose(Vec3(0, 1, 0), turns[3]));
        }
      }
    }
  }
  const Shape others[] = {Plane({0, 0, 1}, 0), Sphere(1),        Capsule(1, 1),  Cylinder(1, 1),
                          Cylinder(1, 2),      Cylinder(0.5, 1), Box({1, 1, 1}), Box({1, 2, 3})};
  for (const Shape& b : others) {
    if (b.index() != c.b.index()) continue;
    for (const double threshold : {0.0, 0.5, 1.0}) {
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(Cylinder(1, 1), b, poses, threshold));
      ASSERT_NO_FATAL_FAILURE(expect_same_bits(Cylinder(1, 2), b, poses, threshold));
    }
  }
}

TEST_P(Batch, HasTheBitsOfSinglePairsAtEveryLength) {
  const Configuration c = make_configuration({GetParam(), "general", 5, 1});
  Poses poses;
  std::size_t apart = 0;
  for (std::size_t count = 0; count < 70; ++count) {
    ASSERT_NO_FATAL_FAILURE(expect_same_bits(c.a, c.b, poses, 0)) << count;
    const Configuration other = make_configuration({GetParam(), "general", 7, count});
    poses.add(other.pose_a, other.pose_b);
    apart += !overlaps({c.a, other.pose_a, c.b, other.pose_b});
  }
  // So that more than single pairs are compared with themselves.
  EXPECT_GE(apart, 5U);
  EXPECT_LE(apart, 65U);
}

TEST_P(Batch, RefusesSpansOfDifferentLengthsAndWritesNothing) {
  const Configuration c = make_configuration({GetParam(), "general", 5, 1});
  const std::vector<Pose> three(3), four(4);
  std::array<SignedDistance, 4> distances;
  std::array<bool, 4> overlap = {true, true, true, true};
  std::array<Contact, 4> contacts;
  for (auto& d : distances) d.value = 7;
  for (auto& x : contacts) x.signed_distance = 7;
  const auto expect_refused = [](const char* text, auto call) {
    EXPECT_EQ(error_text_of(call), text);
  };
  const char* poses = "poses_b.size() is 4: must be that of poses_a, 3";
  const char* results = "results.size() is 4: must be that of poses_a, 3";
  expect_refused(poses, [&] { signed_distance(c.a, three, c.b, four, distances); });
  expect_refused(poses, [&] { overlaps(c.a, three, c.b, four, overlap); });
  expect_refused(poses, [&] { contact(c.a, three, c.b, four, 0, contacts); });
  expect_refused(results, [&] { signed_distance(c.a, three, c.b, three, distances); });
  expect_refused(results, [&] { overlaps(c.a, three, c.b, three, overlap); });
  expect_refused(results, [&] { contact(c.a, three, c.b, three, 0, contacts); });
  EXPECT_EQ(distances[0].value, 7);
  EXPECT_TRUE(overlap[0]);
  EXPECT_EQ(contacts[0].signed_distance, 7);
}

FloatPose to_float(const Pose& p) {
  return FloatPose(p.position().cast<float>(), p.orientation().cast<float>());
}
template <class Answer>
bool same_bytes(const Answer& x, const Answer& y) {
  return std::memcmp(&x, &y, sizeof(Answer)) == 0;  // NOLINT(bugprone-suspicious-memory-comparison)
}
bool same_bytes(const FloatContact& x, const FloatContact& y) {
  return same_bytes(x.normal, y.normal) && same_bytes(x.signed_distance, y.signed_distance) &&
         std::equal(x.points().begin(), x.points().end(), y.points().begin(), y.points().end(),
                    same_bytes<FloatContactPoint>);
}

TEST_P(Batch, InFloatHasTheBitsOfSinglePairsAndThoseOfDoubleRounded) {
  for (std::uint64_t k = 0; k < 50; ++k) {
    const Configuration c = make_configuration({GetParam(), "general", 5, k});
    const auto threshold = static_cast<float>(0.05 * smaller_size(c));
    std::vector<FloatPose> poses_a, poses_b;
    for (std::uint64_t i = 0; i < k; ++i) {
      const Configuration other = make_configuration({GetParam(), "general", 7, i});
      poses_a.push_back(to_float(other.pose_a)), poses_b.push_back(to_float(other.pose_b));
    }
    std::vector<FloatSignedDistance> distances(k);
    std::vector<FloatContact> contacts(k);
    const auto overlap = std::make_unique<bool[]>(k);
    std::visit(
        [&](const auto& b) {
          signed_distance(c.a, poses_a, b, poses_b, distances);
          overlaps(c.a, poses_a, b, poses_b, std::span(overlap.get(), k));
          contact(c.a, poses_a, b, poses_b, threshold, contacts);
          for (std::size_t i = 0; i < k; ++i) {
            const FloatPose &pose_a = poses_a[i], &pose_b = poses_b[i];
            const auto one = signed_distance(c.a, pose_a, b, pose_b);
            ASSERT_TRUE(same_bytes(distances[i], one));
            ASSERT_EQ(overlap[i], overlaps(c.a, pose_a, b, pose_b));
            ASSERT_TRUE(same_bytes(contacts[i], contact(c.a, pose_a, b, pose_b, threshold)));
            const auto exact = signed_distance(c.a, pose_a.in_double(), b, pose_b.in_double());
            ASSERT_EQ(one.value, static_cast<float>(exact.value));
            ASSERT_EQ(one.normal, Eigen::Vector3f(exact.normal.template cast<float>()));
          }
        },
        c.b);
  }
}

TEST(SinglePrecision, RefusesWhatNoPoseIs) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Quaternionf upright = Eigen::Quaternionf::Identity();
  EXPECT_THROW(FloatPose({0, nan, 0}, upright), InvalidInput);
  EXPECT_THROW(FloatPose({0, 0, 0}, {nan, 0, 0, 0}), InvalidInput);
  EXPECT_THROW(FloatPose({0, 0, 0}, {0, 0, 0, 0}), InvalidInput);
  EXPECT_EQ(FloatPose({1, 2, 3}, {0, 0, 2, 0}).in_double().position(), Vec3(1, 2, 3));
}

TEST(SinglePrecision, AnswersWhatOverflowsWithTheLargestFloat) {
  const float most = std::numeric_limits<float>::max();
  const FloatPose far({most, 0, 0}, Eigen::Quaternionf::Identity());
  const FloatPose opposite({-most, 0, 0}, Eigen::Quaternionf::Identity());
  EXPECT_EQ(signed_distance(Cylinder(1, 1), far, Sphere(1), opposite).value, most);
}

TEST(SinglePrecision, PassesThePreviousNormalOn) {
  // The centres coincide: all radial normals tie.
  const Eigen::Vector3f previous(0.6F, 0.8F, 0);
  const FloatContact found =
      contact(Cylinder(1, 3), FloatPose(), Cylinder(1, 3), FloatPose(), 0.0F, &previous);
  EXPECT_LT((found.normal - previous).norm(), 1e-6F);
}

INSTANTIATE_TEST_SUITE_P(, Batch, testing::ValuesIn(all_pairs), name_of_other);

}  // namespace
}  // namespace touchstone
