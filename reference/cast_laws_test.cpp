// Our own routine is held to the laws of casts, on casts of all pairs that rapidcheck draws
// (RC_PARAMS sets their number and seed).
#include "properties/laws/cast_laws.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <string>
#include <vector>

#include "reference/random_casts_test.hpp"

namespace touchstone {
namespace {

TEST(CastLaws, AreKeptByOurRoutine) {
  for (const CastLaw& law : all_cast_laws()) {
    for (const Pair pair : all_pairs) {
      EXPECT_TRUE(rc::check(law.name + ", " + pair_name(pair), [&] {
        Random random(static_cast<std::uint64_t>(*rc::gen::inRange(0, 1 << 30)));
        const CastIdentity identity = any_cast(pair, random);
        const CastQuestion first = make_cast(identity);
        std::vector<CastQuestion> asked;
        if (law.questions) asked = law.questions(first);
        if (law.questions && asked.empty()) return;
        asked.insert(asked.begin(), first);
        std::vector<Cast> answers;
        for (const auto& [c, sweep] : asked) answers.push_back(cast(c, sweep));
        const Configuration& c = first.configuration;
        Bar bar;
        bar.tolerance = distance_tolerance(c, first.sweep) / error_size(c, bar);
        const auto violation = law.judge(first, answers, bar);
        RC_LOG() << to_string(identity) << (violation ? ": " + violation->detail : "");
        RC_ASSERT(!violation);
      }));
    }
  }
}

}  // namespace
}  // namespace touchstone
