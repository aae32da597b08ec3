// What each motion upon a pose promises, and that a cast's name makes it again.
//
// TOUCHSTONE_COUNT sets how many casts of each pair and motion are looked at, by default 40.
#include "properties/casts.hpp"

#include <cmath>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>

#include <nlohmann/json.hpp>

#include "oracle/first_touch.hpp"
#include "properties/files/configuration_json.hpp"
#include "reference/invalid_input.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/support.hpp"

namespace touchstone {
namespace {

using Status = oracle::FirstTouch::Status;
using testing::HasSubstr;

/// Casts of one motion upon the classes of a pair, in turn.
template <class Look>
void look_at_casts(const char* motion, const Look& look) {
  for (const Pair pair : all_pairs) {
    const std::vector<std::string>& classes = pose_classes(pair);
    for (std::uint64_t i = 0; i < tried_of_each(40); ++i) {
      const Identity pose(pair, classes[i * 31 % classes.size()], 5, i);
      const CastIdentity identity{pose, &find_cast_motion(motion)};
      SCOPED_TRACE(to_string(identity));
      look(identity, make_cast(identity));
    }
  }
}

/// Far from the origin, and of a plane far from its own, poses are rounded.
double rounding_of(const Configuration& c) {
  return 1e-13 * scale_of(c) + 1e-15 * (c.pose_a.position().norm() + c.pose_b.position().norm());
}
/// Metres, before A moves.
double gap_of(const CastQuestion& cast) {
  return oracle::truth(cast.configuration).signed_distance.midpoint();
}
double in_sizes(double length, const CastQuestion& cast) {
  return length / larger_size(cast.configuration);
}

TEST(CastMotion, HeadOnStartsApartAndTouchesWhereItGoesFarEnough) {
  int touches = 0, all = 0;
  look_at_casts("head-on", [&](const CastIdentity&, const CastQuestion& cast) {
    const double rounding = rounding_of(cast.configuration);
    const double gap = gap_of(cast), length = cast.sweep.norm();
    EXPECT_GE(in_sizes(gap + rounding, cast), 0.01);
    EXPECT_LE(in_sizes(gap - rounding, cast), 10);
    const Status status = oracle::first_touch(cast.configuration, Sweep(cast.sweep)).status;
    if (std::abs(length - gap) > rounding) {
      EXPECT_EQ(status, length > gap ? Status::touch : Status::never);
    }
    touches += status == Status::touch;
    ++all;
  });
  EXPECT_GT(touches, all / 2);
  EXPECT_LT(touches, all);
}

TEST(CastMotion, NearStartsWithinAThousandthAndGoesTowardsB) {
  double shortest = 1e9, longest = 0;
  look_at_casts("near", [&](const CastIdentity&, const CastQuestion& cast) {
    const double length = in_sizes(cast.sweep.norm(), cast);
    shortest = std::min(shortest, length), longest = std::max(longest, length);
    EXPECT_LE(gap_of(cast),
              1e-3 * larger_size(cast.configuration) + rounding_of(cast.configuration));
  });
  EXPECT_LT(shortest, 1e-4) << "of 1e-6 to 1e6 sizes";
  EXPECT_GT(longest, 1e4);
}

TEST(CastMotion, FarComesFromFiftySizesAndMore) {
  int touches = 0, all = 0;
  look_at_casts("far", [&](const CastIdentity&, const CastQuestion& cast) {
    EXPECT_GE(in_sizes(cast.sweep.norm(), cast), 99);
    touches += oracle::first_touch(cast.configuration, Sweep(cast.sweep)).status == Status::touch;
    ++all;
  });
  EXPECT_GT(touches, all / 4);
}

TEST(CastMotion, GrazingPassesWithinAThousandthOfATouch) {
  int touches = 0, nevers = 0, all = 0;
  look_at_casts("grazing", [&](const CastIdentity& identity, const CastQuestion& cast) {
    // Across the normal, along which the gap is the offset all the way.
    const Configuration& c = cast.configuration;
    if (pair_of(c) != Pair::plane) {  // whose gap doubles do not have
      const Vec3 n = oracle::truth(make_configuration(identity.pose)).normals.front().n;
      EXPECT_LE(std::abs(gap(c, n)), 1e-3 * larger_size(c) + rounding_of(c));
    }
    const Status status = oracle::first_touch(cast.configuration, Sweep(cast.sweep)).status;
    touches += status == Status::touch || status == Status::from_start;
    nevers += status == Status::never;
    ++all;
  });
  EXPECT_GT(touches, all / 5);
  EXPECT_GT(nevers, all / 5);
}

TEST(CastMotion, SlidingIsAlongTheCylindersAxis) {
  look_at_casts("sliding", [](const CastIdentity&, const CastQuestion& cast) {
    const Vec3 axis = cast.configuration.pose_a.unit_orientation() * Vec3::UnitZ();
    EXPECT_NEAR(std::abs(axis.dot(cast.sweep.normalized())), 1, 1e-14);
  });
}

TEST(CastMotion, PassingNeverTouches) {
  look_at_casts("passing", [](const CastIdentity&, const CastQuestion& cast) {
    EXPECT_EQ(oracle::first_touch(cast.configuration, Sweep(cast.sweep)).status, Status::never);
  });
}

TEST(CastMotion, PlacedIsThePoseItself) {
  int inside = 0;
  look_at_casts("placed", [&](const CastIdentity& identity, const CastQuestion& cast) {
    EXPECT_EQ(to_hex_json(cast.configuration), to_hex_json(make_configuration(identity.pose)));
    inside += gap_of(cast) <= 0;
  });
  EXPECT_GT(inside, 0);
}

TEST(CastIdentity, IsReadAsItWasWritten) {
  const char* text = "cylinder-box/side-on-face+turned/42/137/grazing";
  const Subject given = given_configuration(text);
  EXPECT_EQ(given.name, text);
  ASSERT_TRUE(given.sweep);
  EXPECT_THAT(given.description, HasSubstr("A moves across the pose's normal"));
  EXPECT_EQ(to_string(parse_cast_identity(text)), text);
  const CastQuestion again = make_cast(parse_cast_identity(text));
  EXPECT_EQ(to_hex_json(again.configuration), to_hex_json(given.configuration));
  EXPECT_EQ(again.sweep, given.sweep->translation());
}

TEST(CastIdentity, KeepsItsBits) {
  const CastQuestion cast = make_cast(parse_cast_identity("cylinder-box/rim-face/1/0/head-on"));
  EXPECT_EQ(to_hex_json(cast.configuration, Sweep(cast.sweep))["sweep"].dump(),
            R"(["0x1.1a7582b16f108p-8","0x1.9eb209517c43dp-10","0x1.306d2ab73ed3fp-20"])");
}

/// The message of what refuses it.
std::string why_refused(const std::string& text) {
  try {
    given_configuration(text);
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "";
}

TEST(CastIdentity, WithAnUnknownPartIsRefusedByName) {
  EXPECT_THAT(why_refused("cylinder-box/rim-face/1/0/sideways"),
              HasSubstr("identity.motion is \"sideways\": must be one of head-on, near, far"));
  EXPECT_THAT(why_refused("cylinder-box/rim-fake/1/0/near"), HasSubstr("rim-fa"));
  EXPECT_THAT(why_refused("cylinder-box/rim-face/1/x/near"), HasSubstr("identity.index is \"x\""));
  EXPECT_THAT(why_refused("cylinder-cone/rim-face/1/0/near"), HasSubstr("there is no such file"));
}

}  // namespace
}  // namespace touchstone
