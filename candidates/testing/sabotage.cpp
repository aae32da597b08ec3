// A plug-in that fails on purpose as engines fail by accident; for tests.
//
// misdeed:N performs the N-th deed of the list below on every configuration. sabotage performs one
// of them, or none, chosen by the bits of A's position. obedient returns the previous normal that
// it is given. declining answers planes, with a relative error of 1e-6 in the depth if the axis
// lies in the plane; TOUCHSTONE_DECLINE, a number in the environment, multiplies that error, and
// slows down all queries if it is negative. ridged answers planes, too, and errs by up to a
// thousandth of the radius where the axis rises by 0.6, by half of that a billionth beside it: so
// narrow a ridge is not met by chance. stalling never answers where A's x is negative, and
// takes ten milliseconds where it is above 1. hiccuping never answers the first question of all its
// sessions, whatever that is. counting answers with the number of pairs prepared and the number not
// yet released. weighing answers with the numbers of a convex body, each times its place.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <sched.h>
#include <stdexcept>
#include <sys/mman.h>
#include <unistd.h>
#include <vector>

#include "candidates/candidate.h"

struct ts_prepared {
  int deed;
};

namespace {

/// Zero and null, hidden from the compiler.
volatile int nowhere = 0;
int* volatile no_memory = nullptr;
std::vector<std::vector<char>> leaked;

void behave(ts_answer& answer) {
  answer.status = TS_CONTACT;
  answer.signed_distance = -0.01;
  answer.point_count = 1;
  answer.points[0] = {{0, 0, 0}, {0, 0, 1}, 0.01};
  std::memcpy(answer.normal, answer.points[0].normal, sizeof answer.normal);
}

void segfault(ts_answer&) { *no_memory = 1; }
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
    // Writes beyond the array, as a routine does that does not know its size.
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

/// Answers after ten milliseconds of processor time.
void dawdle(ts_answer& answer) {
  constexpr std::clock_t time = CLOCKS_PER_SEC / 100;
  for (const std::clock_t start = std::clock(); std::clock() - start < time;) {
  }
  behave(answer);
}

constexpr void (*deeds[])(ts_answer&) = {
    segfault,     abort_it,    throw_it,    throw_number,   loop,
    sleep_long,   allocate,    leave,       million_points, claim_million_points,
    not_a_number, long_normal, claim_crash, leak,           throw_no_text,
    behave,       dawdle};
constexpr int count = sizeof deeds / sizeof *deeds;

// Usually the last but one, which answers at once.
const ts_parameter which = {"number of the deed", 1, count, count - 1, 1, 0};

int supports(void*, ts_shape_kind kind) { return kind != TS_BOX; }
ts_prepared* prepare(void*, const ts_shape*, const ts_shape*, double, double parameter) {
  return new ts_prepared{static_cast<int>(parameter) - 1};
}
void query(ts_prepared* prepared, const ts_pose*, const ts_pose*, const double*,
           ts_answer* answer) {
  deeds[prepared->deed](*answer);
}
/// Chooses among the deeds that need no waiting; two of three configurations are answered.
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

// declining

double dot(const double* n, const double* v) { return n[0] * v[0] + n[1] * v[1] + n[2] * v[2]; }

/// A unit quaternion's image of `v`.
void rotate(const double* q, const double* v, double* out) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  const double t[3] = {2 * (y * v[2] - z * v[1]), 2 * (z * v[0] - x * v[2]),
                       2 * (x * v[1] - y * v[0])};
  out[0] = v[0] + w * t[0] + y * t[2] - z * t[1];
  out[1] = v[1] + w * t[1] + z * t[0] - x * t[2];
  out[2] = v[2] + w * t[2] + x * t[1] - y * t[0];
}

struct Declining {
  ts_shape a, plane;
  double factor;
};
int supports_planes(void*, ts_shape_kind kind) { return kind == TS_PLANE; }
ts_prepared* prepare_declining(void*, const ts_shape* a, const ts_shape* b, double, double) {
  const char* const factor = std::getenv("TOUCHSTONE_DECLINE");
  return reinterpret_cast<ts_prepared*>(new Declining{*a, *b, factor ? std::atof(factor) : 1});
}
/// Answers with the exact distance; returns |n·u|, zero where the cylinder lies.
double query_planes(const Declining& d, const ts_pose* a, const ts_pose* b, ts_answer* answer) {
  const double z[3] = {0, 0, 1};
  double n[3], u[3], from_plane[3];
  for (int repeated = 0; repeated < (d.factor < 0 ? 500 : 1); ++repeated) {
    rotate(b->orientation, d.plane.size, n);
    rotate(a->orientation, z, u);
    nowhere = nowhere + 0;  // nor is the loop removed
  }
  for (int i = 0; i < 3; ++i) from_plane[i] = a->position[i] - b->position[i];
  const double along = std::fabs(dot(n, u));
  const double across = std::sqrt(std::fmax(0, 1 - along * along));
  const double distance =
      dot(n, from_plane) - d.plane.size[3] - d.a.size[1] * along - d.a.size[0] * across;
  answer->status = distance > 0 ? TS_NONE : TS_CONTACT;
  answer->signed_distance = distance;
  answer->point_count = 0;
  std::memcpy(answer->normal, n, sizeof n);
  return along;
}
void query_declining(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
                     ts_answer* answer) {
  const auto& d = *reinterpret_cast<const Declining*>(prepared);
  const double along = query_planes(d, a, b, answer);
  if (along < 1e-9) answer->signed_distance *= 1 + 1e-6 * std::fabs(d.factor);
}
void query_tiring(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double* hint,
                  ts_answer* answer) {
  static int asked = 0;
  query_declining(prepared, a, b, hint, answer);
  if (++asked >= 40) answer->signed_distance -= 0.1;
}
void query_ridged(ts_prepared* prepared, const ts_pose* a, const ts_pose* b, const double*,
                  ts_answer* answer) {
  constexpr double height = 1e-3, width = 1e-9;
  const auto& d = *reinterpret_cast<const Declining*>(prepared);
  const double beside = std::fabs(query_planes(d, a, b, answer) - 0.6);
  answer->signed_distance += height * d.a.size[0] * width / (width + beside);
}
void release_declining(ts_prepared* p) { delete reinterpret_cast<Declining*>(p); }

void query_stalling(ts_prepared*, const ts_pose* a, const ts_pose*, const double*,
                    ts_answer* answer) {
  const double x = a->position[0];
  (x < 0 ? loop : x > 1 ? dawdle : behave)(*answer);
}

// hiccuping

/// A count that all sessions share.
int& hiccups() {
  static int* const shared = static_cast<int*>(
      mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0));
  return *shared;
}
void query_hiccuping(ts_prepared*, const ts_pose*, const ts_pose*, const double*,
                     ts_answer* answer) {
  (hiccups()++ == 0 ? loop : behave)(*answer);
}

// counting

int prepared_pairs = 0, released_pairs = 0;
ts_prepared* prepare_counted(void*, const ts_shape*, const ts_shape*, double, double) {
  ++prepared_pairs;
  return new ts_prepared{0};
}
void query_counted(ts_prepared*, const ts_pose*, const ts_pose*, const double*, ts_answer* answer) {
  behave(*answer);
  answer->signed_distance = -prepared_pairs;
  answer->points[0].depth = prepared_pairs - released_pairs;
  cpu_set_t allowed;
  sched_getaffinity(0, sizeof allowed, &allowed);
  answer->points[0].position[0] = CPU_COUNT(&allowed);
}
void release_counted(ts_prepared* prepared) {
  ++released_pairs;
  delete prepared;
}

// weighing

struct Weighed {
  double sum = 0;
};
ts_prepared* prepare_weighing(void*, const ts_shape*, const ts_shape* b, double, double) {
  double sum = 0;
  int place = 0;
  for (int i = 0; i < 3 * b->vertex_count; ++i) sum += ++place * b->vertices[i];
  const int* next = b->faces;
  for (int i = 0; i < b->face_count; ++i) {
    for (const int* const end = next + 1 + *next; next < end; ++next) sum += ++place * *next;
  }
  return reinterpret_cast<ts_prepared*>(new Weighed{sum});
}
void query_weighing(ts_prepared* prepared, const ts_pose*, const ts_pose*, const double*,
                    ts_answer* answer) {
  behave(*answer);
  answer->signed_distance = reinterpret_cast<const Weighed*>(prepared)->sum;
}
void release_weighing(ts_prepared* p) { delete reinterpret_cast<Weighed*>(p); }

const ts_candidate candidates[] = {
    {"misdeed", "1", "does one deed", nullptr, &which, supports, prepare, query, release, nullptr,
     nullptr},
    {"sabotage", "1", "does many deeds", nullptr, nullptr, supports, prepare, query_some, release,
     nullptr, nullptr},
    {"obedient", "1", "answers the previous normal", nullptr, nullptr, supports, prepare,
     query_obedient, release, nullptr, nullptr},
    {"declining", "1", "exact for planes but where a cylinder lies", nullptr, nullptr,
     supports_planes, prepare_declining, query_declining, release_declining, nullptr, nullptr},
    {"tiring", "1", "wrong from the fortieth question on", nullptr, nullptr, supports_planes,
     prepare_declining, query_tiring, release_declining, nullptr, nullptr},
    {"ridged", "1", "wrong on a narrow ridge", nullptr, nullptr, supports_planes, prepare_declining,
     query_ridged, release_declining, nullptr, nullptr},
    {"counting", "1", "answers what it has prepared and where it runs", nullptr, nullptr, supports,
     prepare_counted, query_counted, release_counted, nullptr, nullptr},
    {"stalling", "1", "is slow or endless in places", nullptr, nullptr, supports, prepare,
     query_stalling, release, nullptr, nullptr},
    {"hiccuping", "1", "is endless once", nullptr, nullptr, supports, prepare, query_hiccuping,
     release, nullptr, nullptr},
    {"weighing", "1", "answers with a convex body's numbers", nullptr, nullptr, supports,
     prepare_weighing, query_weighing, release_weighing, nullptr, nullptr}};
const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 10, candidates, nullptr, 0, nullptr};

}  // namespace

const ts_plugin* touchstone_plugin() {
  hiccups() = 0;  // made before any session
  return &plugin;
}
