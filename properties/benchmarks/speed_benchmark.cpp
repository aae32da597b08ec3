// Time per query, streaming over thousands of distinct poses of one pair and regime, so that
// neither the caches nor the branch predictor know the answer. Not a test: run it by hand on a
// quiet machine,
//
//   build/release/properties/benchmarks/speed_benchmark --benchmark_filter=box
//
// "mixed" is what a broad phase finds: one pair of shapes in poses of which 83% are apart, asked
// about one by one and in a batch, in double, in float, and in double with poses made for each
// question as those in float are. Its figures are per pair of poses:
//
//   build/release/properties/benchmarks/speed_benchmark --benchmark_filter=mixed
//       --benchmark_repetitions=9 --benchmark_enable_random_interleaving=true
//
// speed_table.py beside this prints the tables of reference/README.md.
#include <benchmark/benchmark.h>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "oracle/hull.hpp"
#include "properties/identity.hpp"
#include "reference/batch.hpp"
#include "reference/contact_of.hpp"
#include "reference/random_bodies_test.hpp"
#include "reference/single_precision.hpp"

namespace touchstone {
namespace {

constexpr std::uint64_t poses = 4096;

std::vector<Configuration> configurations(Pair pair, const std::string& pose_class) {
  std::vector<Configuration> result;
  for (std::uint64_t i = 0; i < poses; ++i) {
    result.push_back(make_configuration({pair, pose_class, 1, i}));
  }
  return result;
}

/// Separate bodies, as in most calls of an engine: A moved away by a tenth of the smaller size.
std::vector<Configuration> apart(Pair pair) {
  std::vector<Configuration> result = configurations(pair, "general+apart");
  for (Configuration& c : result) {
    const Vec3 step = 0.1 * smaller_size(c) * signed_distance(c).normal;
    c.pose_a = Pose(c.pose_a.position() + step, c.pose_a.orientation());
  }
  return result;
}

/// Streams `question` over the poses; the shape's kind is resolved once for all of them.
template <class Question>
void stream(benchmark::State& state, const std::vector<Configuration>& all, Question question) {
  std::visit(
      [&]<class Other>(const Other&) {
        std::size_t next = 0;
        for (auto _ : state) {
          const Configuration& c = all[next++ % poses];
          benchmark::DoNotOptimize(question(c.a, c.pose_a, std::get<Other>(c.b), c.pose_b));
        }
      },
      all.front().b);
}

/// The three questions of the configurations that make() makes.
template <class Make>
void add(const std::string& name, Make make) {
  const auto add_question = [&](const char* question, auto ask) {
    benchmark::RegisterBenchmark((name + "/" + question).c_str(),
                                 [=](benchmark::State& state) { stream(state, make(), ask); });
  };
  add_question("contact", [](const auto&... bodies) { return contact(bodies..., 0); });
  add_question("signed_distance", [](const auto&... bodies) { return signed_distance(bodies...); });
  add_question("overlaps", [](const auto&... bodies) { return overlaps(bodies...); });
}

void add(Pair pair, const std::string& pose_class) {
  add(std::string(pair_name(pair)) + "/" + pose_class,
      [=] { return pose_class == "apart" ? apart(pair) : configurations(pair, pose_class); });
}

/// Hulls of so many points of a sphere of one metre (of three a triangle), in general poses of
/// about this depth.
std::vector<Configuration> against_hulls(int corners, double depth) {
  Random random(1);
  std::vector<Convex> hulls;
  for (int i = 0; i < 16; ++i) {
    std::vector<Vec3> points;
    for (int k = 0; k < corners; ++k) points.push_back(random.direction());
    hulls.push_back(oracle::convex_hull(points));
  }
  std::vector<Configuration> result;
  for (std::uint64_t i = 0; i < poses; ++i) {
    const double radius = random.uniform(0.2, 1), part = random.uniform(0.2, 1);
    const Cylinder a(radius, random.uniform(0.2, 1));
    Configuration c{a, Pose(1.5 * random.direction(), random.turn()), hulls[i % hulls.size()],
                    Pose(Vec3::Zero(), random.turn())};
    for (int k = 0; k < 3; ++k) {
      const SignedDistance found = signed_distance(c);
      c.pose_a = Pose(c.pose_a.position() - (found.value + part * depth) * found.normal,
                      c.pose_a.orientation());
    }
    result.push_back(c);
  }
  return result;
}
void add_hulls(int corners) {
  const std::string body = "cylinder-convex-" + std::to_string(corners) + "/";
  add(body + "general+shallow", [=] { return against_hulls(corners, 0.02); });
  add(body + "general+deep", [=] { return against_hulls(corners, 0.3); });
  add(body + "apart", [=] { return against_hulls(corners, -0.1); });
}

/// Poses of both bodies, at random within the reach of one another's bounding spheres.
struct MixedPoses {
  std::vector<Pose> a, b;

  template <class Other>
  MixedPoses(const Cylinder& shape_a, const Other& shape_b) {
    constexpr auto overlapping = static_cast<std::uint64_t>(0.17 * poses);
    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto turn = [&] {
      const double w = normal(random), x = normal(random), y = normal(random);
      return Eigen::Quaterniond(w, x, y, normal(random));
    };
    const double reach = std::hypot(shape_a.radius(), shape_a.half_length()) + 0.9;
    for (std::uint64_t met = 0, apart = 0; met + apart < poses;) {
      const double x = uniform(random), y = uniform(random), z = uniform(random);
      if (Vec3(x, y, z).norm() > 1) continue;
      const Pose pose_a(reach * Vec3(x, y, z), turn()), pose_b(Vec3::Zero(), turn());
      std::uint64_t& count = overlaps(shape_a, pose_a, shape_b, pose_b) ? met : apart;
      if (count >= (&count == &met ? overlapping : poses - overlapping)) continue;
      ++count;
      a.push_back(pose_a), b.push_back(pose_b);
    }
  }
};

/// Each iteration answers all poses; the time is divided by their number.
template <class Ask>
void add_mixed_question(const std::string& name, const Ask& ask) {
  benchmark::RegisterBenchmark(name.c_str(), [=](benchmark::State& state) {
    for (auto _ : state) {
      ask();
      benchmark::ClobberMemory();
    }
    using benchmark::Counter;
    state.counters["per_pair"] =
        Counter(static_cast<double>(poses), Counter::kIsIterationInvariantRate | Counter::kInvert);
  });
}

/// One by one and in a batch; `as_asked` makes of a stored pose what the functions take.
template <class Distance, class Manifold, class OnePose, class Other, class AsAsked>
void add_mixed_questions(const std::string& name, const Cylinder& a, const Other& b,
                         const std::vector<OnePose>& poses_a, const std::vector<OnePose>& poses_b,
                         AsAsked as_asked, bool has_batches) {
  const auto distances = std::make_shared<std::vector<Distance>>(poses);
  const auto contacts = std::make_shared<std::vector<Manifold>>(poses);
  const auto overlap = std::shared_ptr<bool[]>(new bool[poses]);
  const auto one_by_one = [=](const char* question, const auto& ask) {
    add_mixed_question(name + question + "/single", [=] {
      for (std::size_t i = 0; i < poses; ++i) ask(i, as_asked(poses_a[i]), as_asked(poses_b[i]));
    });
  };
  one_by_one("signed_distance", [=](std::size_t i, const auto& pose_a, const auto& pose_b) {
    (*distances)[i] = signed_distance(a, pose_a, b, pose_b);
  });
  one_by_one("overlaps", [=](std::size_t i, const auto& pose_a, const auto& pose_b) {
    overlap[i] = overlaps(a, pose_a, b, pose_b);
  });
  one_by_one("contact", [=](std::size_t i, const auto& pose_a, const auto& pose_b) {
    (*contacts)[i] = contact(a, pose_a, b, pose_b, 0);
  });
  if (!has_batches) return;
  add_mixed_question(name + "signed_distance/batch",
                     [=] { signed_distance(a, poses_a, b, poses_b, *distances); });
  add_mixed_question(name + "overlaps/batch",
                     [=] { overlaps(a, poses_a, b, poses_b, std::span(overlap.get(), poses)); });
  add_mixed_question(name + "contact/batch",
                     [=] { contact(a, poses_a, b, poses_b, 0, *contacts); });
}

/// Bodies of about one size.
template <class Other>
void add_mixed(const std::string& pair, const Other& b) {
  const Cylinder a(0.5, 0.6);
  const MixedPoses all(a, b);
  const auto to_float = [](const std::vector<Pose>& in_double) {
    std::vector<FloatPose> result;
    for (const Pose& p : in_double) {
      result.emplace_back(p.position().template cast<float>(),
                          p.orientation().template cast<float>());
    }
    return result;
  };
  const auto as_it_is = [](const auto& pose) -> const auto& { return pose; };
  const auto made_anew = [](const Pose& p) { return Pose(p.position(), p.orientation()); };
  const std::string mixed = pair + "/mixed/";
  add_mixed_questions<SignedDistance, Contact>(mixed, a, b, all.a, all.b, as_it_is, true);
  add_mixed_questions<SignedDistance, Contact>(mixed + "poses_made/", a, b, all.a, all.b, made_anew,
                                               false);
  add_mixed_questions<FloatSignedDistance, FloatContact>(mixed + "float/", a, b, to_float(all.a),
                                                         to_float(all.b), as_it_is, true);
}

void add_all() {
  add_mixed("cylinder-plane", Plane(Vec3(0, 0.6, 0.8), -0.1));
  add_mixed("cylinder-sphere", Sphere(0.6));
  add_mixed("cylinder-capsule", Capsule(0.4, 0.5));
  add_mixed("cylinder-cylinder", Cylinder(0.4, 0.8));
  add_mixed("cylinder-box", Box(Vec3(0.6, 0.5, 0.4)));
  for (const int corners : {3, 8, 32, 64}) add_hulls(corners);
  for (const Pair pair : all_pairs) {
    add(pair, "apart");
    const ClassSelection selected{
        .names = {"general+apart", "general+shallow", "general+deep", "concentric", "parallel-side",
                  "cap-on-cap-offset", "cap-on-face-offset", "parallel+tilted-1e-6", "rim-rim"}};
    for (const std::string& pose_class : selected_classes(pair, selected)) add(pair, pose_class);
  }
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) {
  touchstone::add_all();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
