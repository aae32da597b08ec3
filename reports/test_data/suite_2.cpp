#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "reference/invalid_input.hpp"
#include "reports/test_data/small_numbers.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {
namespace {

/// Draws of all classes of a pair, after which none is expected that has not been found before.
constexpr std::uint64_t most_draws = 100;

/// The bits below the smaller size that are tried in turns; without any, all that a float has.
std::vector<std::optional<int>> precisions(const SuiteFile& file) {
  if (file.is_small) return {4, 5, 6, 8, 10, 12, 16, 20, {}};
  return {{}, 20, 16, 12, 10, 8, 6, 5, 4};
}

/// A drawn configuration in numbers that are floats, if bodies can meet there as they did.
std::optional<TestDatum> datum_in_floats(const Identity& identity, const SuiteFile& file) {
  const Configuration drawn = make_configuration(identity);
  const auto tolerance = [](const Configuration& c) {
    return Bar().tolerance * error_size(c, Bar());
  };
  const Meeting meeting = meeting_of(drawn, oracle::truth(drawn), tolerance(drawn));
  for (const std::optional<int> bits : precisions(file)) {
    try {
      Configuration c = in_floats(bits ? on_grid(drawn, file.is_small, *bits) : drawn);
      if (meeting.kind == Meeting::Kind::touching) touch(c);
      if (!is_in_floats(c)) continue;
      const oracle::Truth truth = oracle::truth(c, truth_width);
      if (meeting_of(c, truth, tolerance(c)) != meeting) continue;
      return TestDatum{identity, c, truth, answer_limits(c, truth, Bar())};
    } catch (const InvalidInput&) {  // hulls may lose their corners
    }
  }
  return {};
}

/// In an order in which neighbours are of different arrangements.
std::vector<PoseClass> spread(std::vector<PoseClass> classes) {
  const std::size_t n = classes.size();
  std::size_t step = std::max<std::size_t>(1, n * 5 / 8);
  while (std::gcd(step, n) != 1) ++step;
  std::vector<PoseClass> result;
  for (std::size_t i = 0; i < n; ++i) result.push_back(classes[i * step % n]);
  return result;
}

}  // namespace

const std::vector<SuiteFile>& suite_2_files() {
  using enum Group;
  static const std::vector<SuiteFile> files = {{"smoke", {everyday}, 10, true},
                                               {"everyday", {everyday}, 40, false},
                                               {"hard", {degenerate, extreme}, 25, false}};
  return files;
}

void make_suite_2(const SuiteFile& file, const std::function<void(const TestDatum&)>& take) {
  const std::uint64_t seed = 2;  // the suite's
  for (const Pair pair : all_pairs) {
    std::set<std::uint64_t> known;
    for (const Group group : file.groups) {
      const auto classes = spread(selected(pair, {{}, {group}, Coverage::suite_2}));
      std::size_t found = 0;
      for (std::uint64_t i = 0; i < most_draws * classes.size() && found < file.of_each; ++i) {
        const Identity identity(classes[i % classes.size()], seed, i / classes.size());
        const auto datum = datum_in_floats(identity, file);
        if (!datum || !known.insert(hash_of(datum->configuration)).second) continue;
        take(*datum);
        ++found;
      }
    }
  }
}

}  // namespace touchstone
