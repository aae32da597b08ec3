// Time of one truth, the median over configurations of a pose class:
//
//   build/release/properties/benchmarks/oracle_benchmark
//
// One iteration is a pass over all configurations, its reported time that of the median one.
#include <algorithm>
#include <benchmark/benchmark.h>
#include <chrono>
#include <numeric>
#include <string>
#include <vector>

#include "oracle/truth.hpp"
#include "properties/identity.hpp"

namespace touchstone::oracle {
namespace {

constexpr std::uint64_t configurations = 500;

void median_time(benchmark::State& state, Pair pair, const std::string& pose_class, double width) {
  std::vector<Configuration> inputs;
  for (std::uint64_t i = 0; i < configurations; ++i) {
    inputs.push_back(make_configuration({pair, pose_class, 1, i}));
  }
  std::vector<double> seconds(inputs.size());
  for (auto _ : state) {
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      const auto start = std::chrono::steady_clock::now();
      benchmark::DoNotOptimize(truth(inputs[i], width));
      seconds[i] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    const auto middle = seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2);
    std::nth_element(seconds.begin(), middle, seconds.end());
    state.SetIterationTime(*middle);
    const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
    state.counters["mean_us"] = 1e6 * total / static_cast<double>(seconds.size());
    state.counters["max_us"] = 1e6 * *std::max_element(seconds.begin(), seconds.end());
  }
}

void add(Pair pair, const std::string& pose_class, double width) {
  const std::string name =
      std::string(pair_name(pair)) + "/" + pose_class + (width == 1e-30 ? "/1e-30" : "/1e-13");
  benchmark::RegisterBenchmark(name.c_str(), median_time, pair, pose_class, width)
      ->UseManualTime()
      ->Unit(benchmark::kMicrosecond)
      ->Iterations(5);
}

}  // namespace
}  // namespace touchstone::oracle

int main(int argc, char** argv) {
  using namespace touchstone;
  for (const double width : {1e-30, 1e-13}) {
    for (const Pair pair : all_pairs) {
      for (const std::string& name : pose_classes(pair)) oracle::add(pair, name, width);
    }
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
}
