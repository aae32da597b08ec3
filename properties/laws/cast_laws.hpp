#pragma once

#include <cstddef>
#include <functional>
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

  /// `answers` belong to the cast, then to the questions. Null: it asks for an answer alone.
  std::optional<Violation> (*judge)(const CastQuestion& first, std::span<const Cast> answers,
                                    const Bar& bar);
};

const std::vector<CastLaw>& all_cast_laws();
/// Null if there is none of that name.
const CastLaw* find_cast_law(std::string_view name);

/// The place of a law among all of contacts, then all of casts, and what it states. Throw
/// InvalidInput like find_law.
std::size_t place_of_law(std::string_view name);
const std::string& statement_of_law(std::string_view name);

/// What answers casts, each question's answer at its place.
using AnswersCasts =
    std::function<std::vector<std::optional<CastAnswer>>(std::span<const CastQuestion>)>;

/// Asks what the law asks and judges the answers. None if it holds, says nothing of this cast, or
/// an answer is missing; "cast-answers" alone says where one fails.
std::optional<Violation> broken(const CastLaw& law, const CastQuestion& cast,
                                const AnswersCasts& answers, const Bar& bar);

/// Tries these laws on casts of every class that is selected, of one motion after the other, one
/// for each twenty configurations that `options` asks of a class; simplifies the first failure of
/// each name, or of each name and features, as `check` does. Pairs and laws of which the candidate
/// answers nothing are left out.
std::vector<LawResult> check_casts(const Candidate& candidate, std::span<const CastLaw* const> laws,
                                   const CheckOptions& options);
/// The same of any function; its failures name no candidate.
std::vector<LawResult> check_casts(const AnswersCasts& answers,
                                   std::span<const CastLaw* const> laws,
                                   const CheckOptions& options);

}  // namespace touchstone
