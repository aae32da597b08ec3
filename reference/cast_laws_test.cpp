// Our own routine is held to the laws of casts, on casts of all pairs that rapidcheck draws
// (RC_PARAMS sets their number and seed).
#include "properties/laws/cast_laws.hpp"

#include <gtest/gtest.h>
#include <optional>
#include <rapidcheck.h>
#include <span>
#include <string>
#include <vector>

#include "reference/random_casts_test.hpp"

namespace touchstone {
namespace {

TEST(CastLaws, AreKeptByOurRoutine) {
  const auto answers = [](std::span<const CastQuestion> casts) {
    std::vector<std::optional<CastAnswer>> result;
    for (const auto& [c, sweep] : casts) result.push_back(CastAnswer{cast(c, sweep)});
    return result;
  };
  for (const CastLaw& law : all_cast_laws()) {
    for (const Pair pair : all_pairs) {
      EXPECT_TRUE(rc::check(law.name + ", " + pair_name(pair), [&] {
        Random random(static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 30)));
        const CastIdentity identity = any_cast(pair, random);
        const CastQuestion first = make_cast(identity);
        const Configuration& c = first.configuration;
        Bar bar;
        bar.tolerance = distance_tolerance(c, first.sweep) / error_size(c, bar);
        const auto violation = broken(law, first, answers, bar);
        RC_LOG() << to_string(identity) << (violation ? ": " + violation->detail : "");
        RC_ASSERT(!violation);
      }));
    }
  }
}

}  // namespace
}  // namespace touchstone
