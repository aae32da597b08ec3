// A plug-in that does on purpose what engines do by accident; for tests.
//
// misdeed:N does the N-th deed of the list below on every configuration. sabotage does one of them,
// or none, as the bits of A's position decide: the same one for the same configuration. obedient
// answers whatever previous normal it is given.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <unistd.h>
#include <vector>

#include "candidates/candidate.h"

struct ts_prepared {
  int deed;
};

namespace {

/// Zero where the compiler cannot know it.
volatile std::uintptr_t nowhere = 0;
std::vector<std::vector<char>> leaked;

void behave(ts_answer& answer) {
  answer.status = TS_CONTACT;
  answer.signed_distance = -0.01;
  answer.point_count = 1;
  answer.points[0] = {{0, 0, 0}, {0, 0, 1}, 0.01};
  std::memcpy(answer.normal, answer.points[0].normal, sizeof answer.normal);
}

void segfault(ts_answer&) { *reinterpret_cast<volatile int*>(nowhere) = 1; }
void abort_it(ts_answer&) { std::abort(); }
void throw_it(ts_answer&) { throw std::runtime_error("no convergence"); }
void throw_no_text(ts_answer&) { throw std::runtime_error("no\ntext \xff\xc3"); }
void throw_number(ts_answer&) { throw 42; }
void loop(ts_answer&) {
  while (nowhere == 0) {
  }
}
void sleep_long(ts_answer&) { sleep(1000); }
void allocate(ts_answer&) { leaked.emplace_back(std::size_t{10} << 30); }
void leave(ts_answer&) { std::exit(0); }
void million_points(ts_answer& answer) {
  behave(answer);
  answer.point_count = 1000000;
  for (int i = 0; i < answer.point_count; ++i) {
    // Beyond the array, as a routine does that was never told how many points there are.
    std::memcpy(reinterpret_cast<char*>(answer.points) + i * sizeof(ts_point), answer.points,
                i == 0 ? 0 : sizeof(ts_point));
  }
}
void claim_million_points(ts_answer& answer) {
  behave(answer);
  answer.point_count = 1000000;
}
void not_a_number(ts_answer& answer) {
  behave(answer);
  answer.normal[0] = std::numeric_limits<double>::quiet_NaN();
}
void long_normal(ts_answer& answer) {
  behave(answer);
  for (double& n : answer.normal) n *= 2;
}
void claim_crash(ts_answer& answer) { answer.status = TS_CRASHED; }
void leak(ts_answer& answer) {
  leaked.emplace_back(std::size_t{64} << 20, 'x');
  behave(answer);
}

constexpr void (*deeds[])(ts_answer&) = {
    segfault,     abort_it,    throw_it,    throw_number,   loop,
    sleep_long,   allocate,    leave,       million_points, claim_million_points,
    not_a_number, long_normal, claim_crash, leak,           throw_no_text,
    behave};
constexpr int count = sizeof deeds / sizeof *deeds;

const ts_parameter which = {"number of the deed", 1, count, count, 1, 0};

int supports(ts_shape_kind kind) { return kind != TS_BOX; }
ts_prepared* prepare(const ts_shape*, const ts_shape*, double, double parameter) {
  return new ts_prepared{static_cast<int>(parameter) - 1};
}
void query(ts_prepared* prepared, const ts_pose*, const ts_pose*, const double*,
           ts_answer* answer) {
  deeds[prepared->deed](*answer);
}
/// Of those that need no waiting; two in three configurations are answered.
void query_some(ts_prepared*, const ts_pose* a, const ts_pose*, const double*, ts_answer* answer) {
  constexpr void (*quick[])(ts_answer&) = {
      segfault,     abort_it,    throw_it,       allocate,
      not_a_number, long_normal, million_points, claim_million_points};
  std::uint64_t bits = 0;
  std::memcpy(&bits, &a->position[0], sizeof bits);
  bits = (bits ^ (bits >> 29)) * 0x9e3779b97f4a7c15u >> 40;
  const std::uint64_t deed = bits % 24;
  deed < 8 ? quick[deed](*answer) : behave(*answer);
}
void query_obedient(ts_prepared*, const ts_pose*, const ts_pose*, const double* previous_normal,
                    ts_answer* answer) {
  behave(*answer);
  if (previous_normal) std::memcpy(answer->normal, previous_normal, sizeof answer->normal);
}
void release(ts_prepared* prepared) { delete prepared; }

const ts_candidate candidates[] = {
    {"misdeed", "1", "does one deed", nullptr, &which, supports, prepare, query, release, nullptr},
    {"sabotage", "1", "does many deeds", nullptr, nullptr, supports, prepare, query_some, release,
     nullptr},
    {"obedient", "1", "answers the previous normal", nullptr, nullptr, supports, prepare,
     query_obedient, release, nullptr}};
const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 3, candidates};

}  // namespace

const ts_plugin* touchstone_plugin() { return &plugin; }
