// Time per query, streaming over thousands of distinct poses of one pair and regime, so that
// neither the caches nor the branch predictor know the answer. Not a test: run it by hand on a
// quiet machine,
//
//   build/release/properties/benchmarks/speed_benchmark --benchmark_filter=box
#include <benchmark/benchmark.h>
#include <string>
#include <vector>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"
#include "reference/cylinder_box.hpp"
#include "reference/cylinder_capsule.hpp"
#include "reference/cylinder_cylinder.hpp"
#include "reference/cylinder_plane.hpp"
#include "reference/cylinder_sphere.hpp"

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
  std::vector<Configuration> result = configurations(pair, "general-separated");
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

void add(Pair pair, const std::string& pose_class) {
  const auto name = [&](const char* question) {
    return std::string(pair_name(pair)) + "/" + pose_class + "/" + question;
  };
  const auto add_question = [&](const char* question, auto ask) {
    benchmark::RegisterBenchmark(name(question).c_str(), [=](benchmark::State& state) {
      stream(state, pose_class == "apart" ? apart(pair) : configurations(pair, pose_class), ask);
    });
  };
  add_question("contact", [](const auto&... bodies) { return contact(bodies..., 0); });
  add_question("signed_distance", [](const auto&... bodies) { return signed_distance(bodies...); });
  add_question("overlaps", [](const auto&... bodies) { return overlaps(bodies...); });
}

void add_all() {
  for (const Pair pair : all_pairs) {
    add(pair, "apart");
    for (const std::string& pose_class : pose_classes(pair)) {
      for (const char* regime :
           {"general-separated", "general-shallow", "general-deep", "concentric", "parallel-side",
            "cap-on-cap-offset", "cap-on-face-offset", "near-parallel-1e-6", "rim-rim"}) {
        if (pose_class == regime) add(pair, pose_class);
      }
    }
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
