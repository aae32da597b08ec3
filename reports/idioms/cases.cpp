#include "reports/idioms/cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "properties/numbers.hpp"
#include "properties/pose_class.hpp"
#include "properties/simplify.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaign.hpp"
#include "reports/reproducer/texts.hpp"
#include "reports/test_data/small_numbers.hpp"

namespace touchstone {
namespace {

/// Draws of an arrangement among which one is looked for that the engine gets wrong.
constexpr std::uint64_t draws = 12;
/// Steps by which a case is made simpler after its numbers are rounded.
constexpr int simpler_trials = 60;
/// Places that are rounded otherwise than the origin, metres.
const std::array<Vec3, 3> places = {Vec3(8, 56, 0), Vec3(24, 8, 0), Vec3(-0.3, 40, 0.1)};
Pose placed(const Pose& pose, const Vec3& place) {
  return {pose.position() + place, pose.orientation()};
}
/// Are all lengths floats? Of orientations only those by quarters and thirds of a turn can be.
bool in_float(const Configuration& c) {
  const Numbers numbers = numbers_of(c);
  const auto is_float = [](double x) { return static_cast<double>(static_cast<float>(x)) == x; };
  return std::all_of(numbers.sizes.begin(), numbers.sizes.end(), is_float) &&
         std::all_of(numbers.position_a.begin(), numbers.position_a.end(), is_float) &&
         std::all_of(numbers.position_b.begin(), numbers.position_b.end(), is_float) &&
         is_float(numbers.displacement) &&
         std::all_of(numbers.vertices.begin(), numbers.vertices.end(),
                     [&](const Vec3& v) { return std::all_of(v.begin(), v.end(), is_float); });
}

class Chooser {
 public:
  explicit Chooser(const IdiomQuestion& question) : question_(question) {}

  /// One of so many draws, with small numbers: the first that the engine gets wrong in floats, else
  /// the first that it gets wrong, else the first.
  std::optional<IdiomCase> case_of(const PoseClass& pose_class) const {
    std::optional<IdiomCase> first, wrong;
    for (std::uint64_t i = 0; i < draws; ++i) {
      const Identity identity(pose_class, question_.seed, i);
      const auto drawn = judged(identity, make_configuration(identity));
      if (!drawn || meeting(*drawn).kind == Meeting::Kind::near) continue;
      if (!first) first = drawn;
      if (drawn->verdict == "right") continue;
      IdiomCase small = rounded(*drawn);
      if (in_float(small.configuration)) return small;
      if (!wrong) wrong = small;
    }
    if (wrong) return wrong;
    return first ? std::optional(rounded(*first)) : std::nullopt;
  }

  IdiomCase simplest(const IdiomCase& given) const {
    IdiomCase best = given;
    const auto stays = [&](const Configuration& c) {
      if (in_float(given.configuration) && !in_float(c)) return false;
      auto next = like(given, c);
      if (next) best = std::move(*next);
      return next.has_value();
    };
    simplified(given.configuration, stays, simpler_trials);
    return best;
  }

 private:
  /// The case of these numbers, or nothing where its verdict is unsure or not a report's.
  std::optional<IdiomCase> judged(const Identity& identity, const Configuration& given) const {
    const Configuration c = as_asked(given);
    IdiomCase result{identity, c, oracle::truth(c), 0, 0, "right"};
    result.tolerance = question_.bar.tolerance * error_size(c, question_.bar);
    result.float_tolerance = result.tolerance + moved_by_rounding(c);
    if (!question_.ask) return result;
    const Answer answer = question_.ask(c);
    const double distance = result.truth.signed_distance.midpoint();
    const double tolerance = question_.is_single ? result.float_tolerance : result.tolerance;
    result.verdict = idiom_verdict(c, distance, tolerance, answer);
    for (const double factor : {1 / sure, sure}) {
      if (idiom_verdict(c, distance, factor * tolerance, answer) != result.verdict) return {};
    }
    for (const Vec3& place : question_.is_moved ? places : std::span<const Vec3>()) {
      const Configuration moved{c.a, placed(c.pose_a, place), c.b, placed(c.pose_b, place)};
      if (idiom_verdict(moved, distance, tolerance, question_.ask(moved)) != result.verdict)
        return {};
    }
    const Outcome outcome = score(c, result.truth, answer, question_.bar).outcome;
    const char* const reported = agrees(outcome) ? "right" : outcome_name(outcome);
    if (result.verdict != reported) return {};
    return result;
  }

  static Meeting meeting(const IdiomCase& c) {
    return meeting_of(c.configuration, c.truth, c.tolerance);
  }

  /// The case of other numbers, if bodies meet as in this one and the engine does the same.
  std::optional<IdiomCase> like(const IdiomCase& one, const Configuration& c) const {
    auto next = judged(one.identity, c);
    if (!next || next->verdict != one.verdict || !(meeting(*next) == meeting(one))) return {};
    return next;
  }

  /// All numbers in as few binary digits as leave the case as it is: in B's frame, where that does.
  IdiomCase rounded(const IdiomCase& given) const {
    for (const int bits : {3, 4, 5, 6, 8, 10, 12, 16, 20}) {
      for (const bool in_frame_of_b : {true, false}) {
        try {
          Configuration c = on_grid(given.configuration, in_frame_of_b, bits);
          if (meeting(given).kind == Meeting::Kind::touching) touch(c);
          if (auto next = like(given, c)) return *next;
        } catch (const InvalidInput&) {  // hulls may lose their corners
        }
      }
    }
    return given;
  }

  const IdiomQuestion& question_;
};

/// The class of an arrangement alone: in the world's frame, where that makes sense, for its numbers
/// are smaller there.
PoseClass smallest_class(Pair pair, const Arrangement& arrangement) {
  const auto aligned = parse_pose_class(pair, arrangement.name + "+aligned");
  if (const auto* const found = std::get_if<PoseClass>(&aligned)) return *found;
  return {pair, arrangement.name};
}

}  // namespace

std::vector<IdiomCase> idiom_cases(const IdiomQuestion& question) {
  const Chooser chooser(question);
  std::vector<IdiomCase> cases;
  for (const Pair pair : question.pairs) {
    for (const Arrangement& arrangement : arrangements(pair)) {
      using enum Arrangement::Orientations;
      if (arrangement.orientations == recorded || arrangement.orientations == mixed) continue;
      if (auto found = chooser.case_of(smallest_class(pair, arrangement))) {
        cases.push_back(std::move(*found));
      }
    }
  }
  std::stable_sort(cases.begin(), cases.end(), [](const IdiomCase& a, const IdiomCase& b) {
    const auto rank = [](const IdiomCase& c) {
      return std::pair(c.verdict == "right", complexity(c.configuration));
    };
    return rank(a) < rank(b);
  });
  std::vector<IdiomCase> result;
  for (const IdiomCase& rounded : cases) {
    if (result.size() == question.limit) break;
    IdiomCase next = chooser.simplest(rounded);
    // Arrangements that differ in nothing but their numbers may have become the same.
    const bool is_known = std::any_of(result.begin(), result.end(), [&](const IdiomCase& c) {
      return hash_of(c.configuration) == hash_of(next.configuration);
    });
    if (!is_known) result.push_back(std::move(next));
  }
  std::stable_sort(result.begin(), result.end(), [](const IdiomCase& a, const IdiomCase& b) {
    return pair_of(a.configuration) < pair_of(b.configuration);
  });
  return result;
}

}  // namespace touchstone
