#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "candidates/host/ask_cast.hpp"
#include "oracle/judge/cast_score.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/identity.hpp"
#include "reference/sweep.hpp"
#include "reports/terminal.hpp"

namespace touchstone {

/// A candidate's answer to a cast.
struct ScoredCast {
  std::string candidate;
  CastAnswer answer;
  CastScore score;
};

/// One cast: its truth, and the answers of those candidates that have casts.
struct CastExamination {
  Configuration configuration;
  Sweep sweep;
  oracle::FirstTouch truth;
  std::vector<ScoredCast> answers;
};

/// Asks those of the candidates that have casts; none of them has any of a body that turns.
CastExamination examine_cast(const Configuration& configuration, const Sweep& sweep,
                             const std::vector<const Candidate*>& candidates, const Bar& bar);

/// {"truth": {"status", "fraction": [lo, hi], "there": as `truth` of solve, of a touch and from the
/// start}, "answers": {candidate: {"status", "fraction", "normal", "score": {…}}}}.
nlohmann::json to_json(const CastExamination& cast, Order order = Order::as_ours);

/// What is proven of a first touch, as a sentence without its full stop.
std::string first_touch_text(const oracle::FirstTouch& touch);
/// A line on the truth, a table of the answers, and the cast as a line for solve.
std::string cast_text(const CastExamination& cast, const Terminal& terminal = {});

}  // namespace touchstone
