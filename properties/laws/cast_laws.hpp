#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "properties/casts.hpp"
#include "properties/laws/check.hpp"

namespace touchstone {

/// A property of every right cast, whatever its method: a pure function that asks a fixed list of
/// casts and judges the answers by the distances that they leave.
struct CastLaw {
  std::string name;
  std::string statement;  ///< one sentence

  /// The casts that are asked besides the first one; where there are none the law says nothing of
  /// that one. Null: it judges the first answer alone.
  std::vector<CastQuestion> (*questions)(const CastQuestion& first);

  /// `answers` belong to the cast, then to the questions.
  std::optional<Violation> (*judge)(const CastQuestion& first, std::span<const Cast> answers,
                                    const Bar& bar);
};

const std::vector<CastLaw>& all_cast_laws();
/// Null if there is none of that name.
const CastLaw* find_cast_law(std::string_view name);

/// What answers casts, each question's answer at its place.
using AnswersCasts =
    std::function<std::vector<std::optional<CastAnswer>>(std::span<const CastQuestion>)>;

/// One law on the casts of one pair.
struct CastLawResult {
  const CastLaw* law;
  Pair pair;
  std::uint64_t tried = 0, broken = 0;
  std::map<std::string, std::uint64_t> counts = {};  ///< of the broken, by the failure's name
  /// The first cast that breaks it, and how.
  std::string identity = {};
  std::optional<Violation> violation = {};
};

/// Tries these laws on casts of every class that is selected, of one motion after the other, one
/// for each twenty configurations that `options` asks of a class. Pairs and laws of which the
/// candidate answers nothing are left out.
std::vector<CastLawResult> check_casts(const AnswersCasts& answers,
                                       std::span<const CastLaw* const> laws,
                                       const CheckOptions& options);

}  // namespace touchstone
