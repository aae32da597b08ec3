// What surrounds the routines: batches, and single precision.
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "verification/mutation/judge.hpp"

namespace touchstone::mutation {
namespace {

bool same_bits(double x, double y) {
  return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
}
bool same_bits(const Numbers3& x, const Numbers3& y) {
  return same_bits(x[0], y[0]) && same_bits(x[1], y[1]) && same_bits(x[2], y[2]);
}
bool same_bits(const RawContact& x, const RawContact& y) {
  bool same = same_bits(x.signed_distance, y.signed_distance) && same_bits(x.normal, y.normal) &&
              x.count == y.count;
  for (std::size_t i = 0; same && i < x.count; ++i) {
    same = same_bits(x.points[i].position, y.points[i].position) &&
           same_bits(x.points[i].depth, y.points[i].depth);
  }
  return same;
}

double in_float(double x) {
  constexpr double max_float = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(x, -max_float, max_float));
}
template <std::size_t n>
std::array<double, n> in_float(std::array<double, n> all) {
  for (double& x : all) x = in_float(x);
  return all;
}
RawAnswers in_float(RawAnswers x) {
  x.distance.value = in_float(x.distance.value), x.distance.normal = in_float(x.distance.normal);
  RawContact& contact = x.contact;
  contact.signed_distance = in_float(contact.signed_distance);
  contact.normal = in_float(contact.normal);
  for (std::size_t i = 0; i < contact.count; ++i) {
    RawPoint& p = contact.points[i];
    p = {in_float(p.position), in_float(p.depth)};
  }
  return x;
}

RawAnswers one_by_one(const void* made, const Routines& routines, double threshold,
                      const Numbers3* hint) {
  return {routines.signed_distance(made), routines.overlaps(made),
          routines.contact(made, threshold, hint)};
}

using Expect = std::function<void(bool, Check, int)>;

void expect_same(const RawAnswers& x, const RawAnswers& y, Check check, int variant,
                 const Expect& expect) {
  expect(same_bits(x.distance.value, y.distance.value) &&
             same_bits(x.distance.normal, y.distance.normal),
         check, variant);
  expect(x.overlaps == y.overlaps, check, variant + 1);
  expect(same_bits(x.contact, y.contact), check, variant + 2);
}

void judge_in_double(const RawConfiguration& raw, const void* made, const Routines& routines,
                     std::size_t count, double threshold, const Expect& expect) {
  const char* field = nullptr;
  const void* other = routines.make(with_poses_exchanged(raw), &field);
  if (!other) return expect(false, Check::batch, 3);
  std::vector<RawAnswers> answers(count);
  routines.batch(made, Batch::in_double, count, threshold, nullptr, answers.data());
  const RawAnswers single[] = {one_by_one(made, routines, threshold, nullptr),
                               one_by_one(other, routines, threshold, nullptr)};
  for (std::size_t i = 0; i < count; ++i) {
    expect_same(answers[i], single[i % 2], Check::batch, 0, expect);
  }
  routines.release(other);
}

/// Judges the batches in single precision, for the bodies with their poses rounded to float.
void judge_in_float(RawConfiguration raw, const Routines& routines, std::size_t count,
                    double threshold, const Expect& expect) {
  raw.position_a = in_float(raw.position_a), raw.position_b = in_float(raw.position_b);
  raw.orientation_a = in_float(raw.orientation_a), raw.orientation_b = in_float(raw.orientation_b);
  const char* field = nullptr;
  const void* made = routines.make(raw, &field);
  if (!made) return;  // a quaternion that vanishes in float
  const Numbers3 some = in_float(Numbers3{0.36, -0.48, 0.8});
  std::vector<RawAnswers> answers(count);
  for (const Numbers3* hint : {static_cast<const Numbers3*>(nullptr), &some}) {
    routines.batch(made, Batch::in_float_one_by_one, 1, threshold, hint, answers.data());
    expect_same(answers[0], in_float(one_by_one(made, routines, threshold, hint)), Check::in_float,
                0, expect);
  }
  routines.batch(made, Batch::in_float, count, threshold, nullptr, answers.data());
  const RawAnswers expected = in_float(one_by_one(made, routines, threshold, nullptr));
  for (std::size_t i = 0; i < count; i += 2) {
    expect_same(answers[i], expected, Check::in_float, 3, expect);
  }
  routines.release(made);
}

}  // namespace

RawConfiguration with_poses_exchanged(RawConfiguration raw) {
  std::swap(raw.position_a, raw.position_b);
  std::swap(raw.orientation_a, raw.orientation_b);
  return raw;
}

void judge_batches(const Case& c, const void* made, const Routines& routines,
                   const std::function<void(bool, Check, int)>& expect) {
  // Some are of more pairs than are looked at together.
  constexpr std::size_t few = 2, many = 18, seldom = 16;
  const std::size_t count = std::hash<std::string>()(c.identity) % seldom == 0 ? many : few;
  const double threshold = in_float(static_cast<double>(0.01L * Geometry(c.raw).smaller_size()));
  judge_in_double(c.raw, made, routines, count, threshold, expect);
  judge_in_float(c.raw, routines, count, threshold, expect);
}

Findings judge_refusals(const Routines& routines) {
  Findings findings;
  RawConfiguration valid;
  valid.pair = sphere;
  valid.sizes = {1, 1, 1, 1, 1};
  valid.orientation_a = valid.orientation_b = {1, 0, 0, 0};
  const char* field = nullptr;
  const void* made = routines.make(valid, &field);
  bool right = made != nullptr;
  for (const Batch how : {Batch::in_double, Batch::in_float}) {
    for (int question = 0; right && question < 3; ++question) {
      const auto refused = [&](std::size_t poses_b, std::size_t results) {
        return std::string(routines.refused_batch(made, how, question, poses_b, results));
      };
      right = refused(3, 3).empty() && refused(4, 4) == "poses_b.size()" &&
              refused(3, 4) == "results.size()";
    }
  }
  if (!right) findings.set(static_cast<std::size_t>(Check::refusal) * max_variants);
  if (made) routines.release(made);
  return findings;
}

}  // namespace touchstone::mutation
