// What engines answer about convex bodies, in contacts whose depth and normal are known on paper;
// docs/engines.md has it in words. The tests detect a new version that changes it.
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "candidates/testing/plain_contacts.hpp"

namespace touchstone {
namespace {

/// A cylinder that comes free upward after 0.05, which is how deep it is in a body below.
struct DeepContact {
  const char* name;
  Convex body;
  Vec3 position;
  Quaternion orientation;
};

const std::vector<DeepContact>& deep_contacts() {
  const auto hull = [](const std::vector<Vec3>& points) { return oracle::convex_hull(points); };
  const Convex tetrahedron = hull({{-1, -1, 0}, {1, -1, 0}, {0, 1.5, 0}, {0, 0, 1}});
  const Convex floor = hull({{-2, -2, 0}, {2, -2, 0}, {0, 2, 0}});
  const Convex square = hull({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}});
  const Convex edge_up = hull({{-2, 0, 0}, {2, 0, 0}, {0, 0, -2}});
  const Convex corner_up = hull({{0, 0, 0}, {-1, 0, -2}, {1, 0, -2}});
  static const std::vector<DeepContact> all = {
      {"standing on a tip", tetrahedron, {0.1, 0.05, 1.95}, upright},
      {"lying on a tip", tetrahedron, {0.1, 0, 1.45}, along_x},
      {"standing on a triangle", floor, {0, -0.5, 0.95}, upright},
      {"lying on a triangle", floor, {0, -0.5, 0.45}, along_x},
      {"lying on a square", square, {0.1, -0.5, 0.45}, along_x},
      {"standing on an edge", edge_up, {0.2, 0.1, 0.95}, upright},
      {"lying across an edge", edge_up, {0.2, 0.1, 0.45}, along_y},
      {"standing on a corner", corner_up, {0.1, 0.1, 0.95}, upright},
      {"lying on a corner", corner_up, {0, 0.3, 0.45}, along_y},
  };
  return all;
}

constexpr double depth = 0.05, gap = 0.01;

Configuration of(const DeepContact& contact, double lift = 0) {
  return {Cylinder(0.5, 1), Pose(contact.position + Vec3(0, 0, lift), contact.orientation),
          contact.body, Pose()};
}

/// Calls check(answer, contact) of every contact; with the cylinder lifted, at a gap.
template <class Check>
void for_contacts(const std::string& candidate, double lift, const Check& check) {
  for (const DeepContact& contact : deep_contacts()) {
    SCOPED_TRACE(candidate + ' ' + contact.name);
    check(answer(candidate, of(contact, lift)), contact);
  }
}

bool is_flat(const DeepContact& contact) { return contact.body.is_flat(); }

TEST(ConvexContacts, AreThoseOnPaperInOurRoutines) {
  for (const auto& [name, accuracy] : {std::pair("reference", 1e-13), {"reference-float", 1e-6}}) {
    for_contacts(name, 0, [&, most = accuracy](const Answer& a, const DeepContact&) {
      ASSERT_EQ(a.status, TS_CONTACT) << a.reason;
      EXPECT_NEAR(a.signed_distance, -depth, most);
      EXPECT_GT(a.normal[2], 1 - most);
    });
    for_contacts(name, depth + gap,
                 [](const Answer& a, const DeepContact&) { EXPECT_EQ(a.status, TS_NONE); });
  }
}

TEST(ConvexContacts, AreFoundWhereEdgesAreSharp) {
  // On a corner a side's normal is found by searches to 2 mm and 6 degrees: libccd's are to 1e-4 m.
  constexpr double accuracy = 2e-3, cosine = 0.995;
  for (const char* name : {"bullet-margin-0", "bullet-float-margin-0", "ode", "fcl", "fcl-indep",
                           "fcl-distance", "libccd-gjk", "libccd-mpr"}) {
    for_contacts(name, 0, [&](const Answer& a, const DeepContact&) {
      ASSERT_EQ(a.status, TS_CONTACT) << a.reason;
      EXPECT_NEAR(a.signed_distance, -depth, accuracy);
      EXPECT_GT(a.normal[2], cosine);
      EXPECT_EQ(a.point_count, 1);
    });
    for_contacts(name, depth + gap,
                 [](const Answer& a, const DeepContact&) { EXPECT_EQ(a.status, TS_NONE); });
  }
}

TEST(ConvexContacts, AreDeeperByBulletsMargin) {
  constexpr double margin = 0.04, accuracy = 1e-3;
  for (const char* name : {"bullet", "bullet-persistent", "bullet-float"}) {
    for (const double distance : {-depth, gap}) {
      for_contacts(name, depth + distance, [&](const Answer& a, const DeepContact&) {
        ASSERT_EQ(a.status, TS_CONTACT) << a.reason;
        EXPECT_NEAR(a.signed_distance, distance - margin, accuracy);
      });
    }
  }
}

TEST(ConvexContacts, OfFlatBodiesAreNotMujocos) {
  for_contacts("mujoco", 0, [](const Answer& a, const DeepContact& contact) {
    ASSERT_EQ(a.status, is_flat(contact) ? TS_UNSUPPORTED : TS_CONTACT) << a.reason;
    if (!is_flat(contact)) {
      EXPECT_NEAR(a.signed_distance, -depth, 5e-4);
    }
  });
}

TEST(ConvexContacts, AreMissedByOdesMeshes) {
  std::set<std::string> missed;
  for_contacts("ode-mesh:16", 0, [&](const Answer& a, const DeepContact& contact) {
    if (a.status == TS_NONE) missed.insert(contact.name);
  });
  EXPECT_EQ(missed, (std::set<std::string>{"standing on a tip", "lying on a tip",
                                           "lying on a triangle", "lying on a square",
                                           "standing on an edge", "standing on a corner"}));
}

TEST(ConvexContacts, OfModelsAreAsDeepAsTheModel) {
  for (const char* name : {"bullet-hull:16", "capsule", "spheres:8", "prism:16"}) {
    for_contacts(name, 0, [&](const Answer& a, const DeepContact&) {
      ASSERT_EQ(a.status, TS_CONTACT) << a.reason;
      ASSERT_TRUE(a.model_distance);
      EXPECT_NEAR(a.signed_distance, *a.model_distance, 1e-9);
      EXPECT_GE(*a.model_distance, -depth - 1e-12);  // inside the cylinder
    });
  }
}

}  // namespace
}  // namespace touchstone
