// How long the slowest answers take: median, p95, p99.9 and maximum of `contact` over single
// configurations of each pose class, the slowest class first, with the identity of the slowest one.
//
//   build/release/properties/benchmarks/tail_benchmark [REGEX] [--count=2000] [--threshold=0]
//       [--rounds=9] [--triples]
//
// REGEX selects among "pair/class"; --triples draws the classes of a campaign; the contact
// threshold is a part of the smaller size. Each configuration is timed singly, streaming over all
// of its class so that neither the caches nor the branch predictor know the answer, and counts with
// its least time of all rounds; what reading the clock takes is subtracted. The clock of some
// processors advances in steps of 10 ns.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <string>
#include <vector>

#include "properties/identity.hpp"
#include "reference/contact_of.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

double nanoseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

/// What an interval without anything in it takes.
double clock_overhead() {
  double least = 1e9;
  for (int i = 0; i < 10000; ++i) least = std::min(least, nanoseconds_since(Clock::now()));
  return least;
}

struct Options {
  std::string selected;
  std::uint64_t count = 2000;
  double threshold = 0;
  int rounds = 9;
  Coverage coverage = Coverage::pairs;
};

struct Tail {
  std::string name;
  double median, p95, p999, max;
  std::uint64_t slowest;
};

template <class Other>
void time_round(const std::vector<Configuration>& all, double threshold,
                std::vector<double>& least) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Configuration& c = all[i];
    const Other& b = std::get<Other>(c.b);
    const double margin = threshold * smaller_size(c);
    const auto start = Clock::now();
    const volatile double used = contact(c.a, c.pose_a, b, c.pose_b, margin).signed_distance;
    least[i] = std::min(least[i], nanoseconds_since(start));
    static_cast<void>(used);
  }
}

Tail measure(const std::string& name, const std::vector<Configuration>& all,
             const Options& options) {
  static const double overhead = clock_overhead();
  std::vector<double> least(all.size(), 1e9);
  for (int round = 0; round < options.rounds; ++round) {
    std::visit([&]<class Other>(const Other&) { time_round<Other>(all, options.threshold, least); },
               all.front().b);
  }
  const auto slowest = std::max_element(least.begin(), least.end()) - least.begin();
  std::sort(least.begin(), least.end());
  const auto quantile = [&](double part) {
    const double rank = std::ceil(part * static_cast<double>(least.size()));
    return std::max(0.0, least[static_cast<std::size_t>(rank) - 1] - overhead);
  };
  return {name,           quantile(0.5),
          quantile(0.95), quantile(0.999),
          quantile(1),    static_cast<std::uint64_t>(slowest)};
}

std::vector<Configuration> configurations(Pair pair, const std::string& pose_class,
                                          std::uint64_t count) {
  std::vector<Configuration> result;
  for (std::uint64_t i = 0; i < count; ++i) {
    result.push_back(make_configuration({pair, pose_class, 1, i}));
  }
  return result;
}

void print(std::vector<Tail> tails) {
  std::sort(tails.begin(), tails.end(), [](const Tail& a, const Tail& b) { return a.p95 > b.p95; });
  std::printf("   p95  median   p99.9     max  (ns)\n");
  for (const Tail& t : tails) {
    std::printf("%6.0f  %6.0f  %6.0f  %6.0f  %s/1/%llu%s\n", t.p95, t.median, t.p999, t.max,
                t.name.c_str(), static_cast<unsigned long long>(t.slowest),
                t.p95 > 4 * t.median ? "  p95 > 4 medians" : "");
  }
}

void run(const Options& options) {
  const std::regex selected(options.selected);
  std::vector<Tail> tails;
  for (const Pair pair : all_pairs) {
    std::vector<std::string> classes = pose_classes(pair, options.coverage);
    classes.emplace_back("hostile");
    for (const std::string& pose_class : classes) {
      const std::string name = std::string(pair_name(pair)) + "/" + pose_class;
      if (!std::regex_search(name, selected)) continue;
      tails.push_back(measure(name, configurations(pair, pose_class, options.count), options));
    }
  }
  print(std::move(tails));
}

Options parse(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i], name = argument.substr(0, argument.find('=') + 1);
    const std::string value = argument.substr(name.size());
    if (name == "--count=") {
      options.count = std::stoull(value);
    } else if (name == "--threshold=") {
      options.threshold = std::stod(value);
    } else if (name == "--rounds=") {
      options.rounds = std::stoi(value);
    } else if (argument == "--triples") {
      options.coverage = Coverage::triples;
    } else {
      options.selected = argument;
    }
  }
  return options;
}

}  // namespace
}  // namespace touchstone

int main(int argc, char** argv) { touchstone::run(touchstone::parse(argc, argv)); }
