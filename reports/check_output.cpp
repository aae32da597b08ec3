#include "reports/check_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

#include <nlohmann/json.hpp>

#include "oracle/first_touch.hpp"
#include "properties/files/given_text.hpp"
#include "properties/laws/cast_laws.hpp"
#include "properties/laws/failure_file.hpp"
#include "reports/examine_cast.hpp"
#include "reports/replay.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// As in the answer's JSON, which has no word for what is not finite.
std::string number_text(double x) {
  return std::isfinite(x) ? json(x).dump() : std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
}

std::string answer_words(const std::optional<ts_answer>& answer) {
  if (!answer) return "-";
  if (answer->status != TS_CONTACT) return status_name(answer->status);
  const double* const n = answer->normal;
  return fmt::format("signed distance {} m, normal [{},{},{}], {}",
                     number_text(answer->signed_distance), number_text(n[0]), number_text(n[1]),
                     number_text(n[2]), counted(answer->point_count, "point"));
}

/// What was found, and the law that it breaks.
std::string breach_text(const Failure& f, const Terminal& terminal) {
  return terminal.folded(fmt::format("{} {}, {}: {}", pair_name(pair_of(f.configuration)), f.law,
                                     f.violation.failure, f.violation.detail)) +
         terminal.below(statement_of_law(f.law));
}

/// The configuration once, in the command that shows it again.
std::string case_text(const Failure& f, const Terminal& terminal) {
  const auto group = group_met(f);
  const std::string met = terminal.below(
      fmt::format("first met{} as {}; simplified:",
                  group ? fmt::format(" in {} poses", group_name(*group)) : "", f.identity));
  const std::string replays = piped_to_replay(f.configuration, f.sweep, {f.candidate});
  if (f.sweep) {
    const auto touch = oracle::first_touch(f.configuration, Sweep(*f.sweep));
    return met + fmt::format("  {} --candidates {}\n", replays, f.candidate) +
           terminal.below("truth: " + first_touch_text(touch));
  }
  const oracle::Enclosure truth = oracle::truth(f.configuration).signed_distance;
  return met +
         fmt::format("  {} --candidates {} --threshold {}\n", replays, f.candidate,
                     f.bar.threshold) +
         terminal.below(fmt::format("truth: signed distance {} m", nearest_to_middle(truth))) +
         terminal.below("answer: " + answer_words(f.answer));
}

}  // namespace

std::string failure_text(const Failure& f, const Terminal& terminal) {
  return breach_text(f, terminal) + case_text(f, terminal);
}

namespace {

/// "3 missed, 1 shallow"
std::string listed(const std::map<std::string, std::uint64_t>& counts) {
  std::string text;
  for (const auto& [name, count] : counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  }
  return text;
}

/// The same; and "known: 12 missed".
std::string counts_text(const LawResult& result) {
  std::string text = listed(result.counts);
  if (result.known.empty()) return text;
  return text + (text.empty() ? "" : "; ") + "known: " + listed(result.known);
}

std::string xml_escaped(const std::string& text) {
  constexpr std::string_view special = "&<>\"";
  constexpr const char* names[] = {"&amp;", "&lt;", "&gt;", "&quot;"};
  std::string result;
  for (const char c : text) {
    const auto at = special.find(c);
    result += at == special.npos ? std::string(1, c) : names[at];
  }
  return result;
}

const char* result_name(ReplayedFailure::Result result) {
  constexpr std::array names = {"as expected", "fixed", "changed", "skipped"};
  return names[static_cast<std::size_t>(result)];
}

/// Whether it fails a run. A failure that is known may be fixed, but has to be asked.
bool is_failing(const ReplayedFailure& r, bool is_known) {
  using Result = ReplayedFailure::Result;
  return r.result == Result::changed || r.result == (is_known ? Result::skipped : Result::fixed);
}

std::string corpus_name(const Failure& f) {
  return fmt::format("{}, {}, {}, {}{}{}", f.candidate, pair_name(pair_of(f.configuration)), f.law,
                     f.violation.failure, f.features.empty() ? "" : ", ", f.features);
}

/// What came of a law, beside its name or, on a narrow terminal, below it.
std::string law_text(const LawResult& r, const Terminal& terminal) {
  constexpr std::size_t verdict_at = 29, counts_at = 46, min_room = 24;
  const std::string verdict = r.broken > 0      ? fmt::format("broken by {}", r.broken)
                              : r.known.empty() ? "passed"
                                                : "nothing new";
  const auto coloured = [&](const std::string& text) {
    if (r.broken > 0) return terminal.bad(text);
    return r.known.empty() ? terminal.good(text) : text;
  };
  const std::string name = fmt::format("  {:<13}{:>6} tried", r.law, r.tried);
  const std::string counts = counts_text(r);
  if (!counts.empty() && terminal.columns >= counts_at + min_room) {
    const std::string beside =
        wrapped(counts, terminal.columns - counts_at, '\n' + std::string(counts_at, ' '));
    return name + "  " + coloured(fmt::format("{:<16}", verdict)) + ' ' + beside + '\n';
  }
  std::string text = terminal.columns >= verdict_at + verdict.size()
                         ? name + "  " + coloured(verdict) + '\n'
                         : name + "\n    " + coloured(verdict) + '\n';
  return counts.empty() ? text
                        : text + "    " + wrapped(counts, terminal.columns - 4, "\n    ") + '\n';
}

}  // namespace

bool CheckResult::has_failed() const {
  const auto fails = [](const std::vector<ReplayedFailure>& failures, bool are_known) {
    return std::ranges::any_of(failures,
                               [&](const ReplayedFailure& r) { return is_failing(r, are_known); });
  };
  return fails(corpus, false) || fails(known, true) ||
         std::ranges::any_of(laws, [](const LawResult& r) { return r.broken > 0; });
}

std::string check_text(const std::vector<LawResult>& results, const Terminal& terminal) {
  std::string text, last;
  for (const LawResult& r : results) {
    const std::string pair =
        (find_cast_law(r.law) ? "casts of " : "") + std::string(pair_name(r.pair));
    if (pair != last) text += '\n' + terminal.heading(pair) + '\n';
    if (r.tried == 0) {
      if (pair != last) text += terminal.below("no routine: no law was tried");
      last = pair;
      continue;
    }
    if (pair != last && r.unsupported > 0) {
      text += terminal.below(fmt::format("no routine for {}, which no law was tried on",
                                         counted(r.unsupported, "configuration")));
    }
    last = pair;
    text += law_text(r, terminal);
  }
  std::vector<const Failure*> firsts;
  for (const LawResult& r : results) {
    if (!r.failures.empty()) firsts.push_back(&r.failures.front());
  }
  std::stable_sort(firsts.begin(), firsts.end(), [](const Failure* a, const Failure* b) {
    return order_of(group_met(*a)) < order_of(group_met(*b));
  });
  std::vector<std::pair<std::string, std::string>> cases;  // with all that each breaks
  for (const Failure* f : firsts) {
    const std::string shown = case_text(*f, terminal);
    auto at = std::ranges::find(cases, shown, &std::pair<std::string, std::string>::first);
    if (at == cases.end()) at = cases.insert(at, {shown, ""});
    at->second += breach_text(*f, terminal);
  }
  for (const auto& [shown, breaches] : cases) text += '\n' + breaches + shown;
  return text;
}

std::string corpus_text(const std::vector<ReplayedFailure>& corpus, const Terminal& terminal) {
  std::string text;
  for (const ReplayedFailure& r : corpus) {
    const bool is_known = r.now.empty() || r.result == ReplayedFailure::Result::as_expected;
    const std::string name =
        corpus_name(r.expected) + (is_known ? "" : fmt::format(" ({})", r.now));
    text += fmt::format("  {:<12} {}\n", result_name(r.result),
                        wrapped(name, terminal.columns - 15, "\n" + std::string(15, ' ')));
  }
  return text;
}

std::string junit_xml(const CheckResult& result) {
  const Terminal unbounded{.columns = 1000000};
  std::string cases;
  int failures = 0, skipped = 0;
  const auto skip = [&](const std::string& message) {
    ++skipped;
    cases += fmt::format("<skipped message=\"{}\"/>", xml_escaped(message));
  };
  double seconds = 0;
  for (const LawResult& r : result.laws) {
    seconds += r.seconds;
    cases += fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.3f}\">",
                         xml_escaped(result.candidate), pair_name(r.pair), r.law, r.seconds);
    if (r.tried == 0) skip("no routine for the pair");
    if (r.broken == 0 && !r.known.empty()) skip(counts_text(r));
    if (r.broken > 0) {
      ++failures;
      cases += fmt::format("<failure type=\"{}\" message=\"{}\">{}</failure>",
                           xml_escaped(r.failures.front().violation.failure),
                           xml_escaped(counts_text(r)),
                           xml_escaped(failure_text(r.failures.front(), unbounded)));
    }
    cases += "</testcase>\n";
  }
  using Result = ReplayedFailure::Result;
  const auto add_saved = [&](const ReplayedFailure& r, const char* kind, bool is_known) {
    cases +=
        fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\">",
                    xml_escaped(r.expected.candidate), kind, xml_escaped(corpus_name(r.expected)));
    if (is_failing(r, is_known)) {
      ++failures;
      cases += fmt::format("<failure type=\"{}\">{}</failure>", result_name(r.result),
                           xml_escaped(r.now));
    } else if (r.result == Result::skipped) {
      skip(r.now);
    } else if (is_known && r.result == Result::as_expected) {
      skip("known: " + r.now);
    }
    cases += "</testcase>\n";
  };
  for (const ReplayedFailure& r : result.corpus) add_saved(r, "corpus", false);
  for (const ReplayedFailure& r : result.known) add_saved(r, "known", true);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"touchstone check\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" "
      "time=\"{:.3f}\">\n{}"
      "  </testsuite>\n</testsuites>\n",
      result.laws.size() + result.corpus.size() + result.known.size(), failures, skipped, seconds,
      cases);
}

json check_json(const CheckResult& result, const CheckOptions& options) {
  json laws = json::array(), groups = json::array();
  for (const Group group : options.groups) groups.push_back(group_name(group));
  for (const LawResult& r : result.laws) {
    json failures = json::array();
    for (const Failure& f : r.failures) failures.push_back(to_json(f));
    laws.push_back({{"law", r.law},
                    {"pair", pair_name(r.pair)},
                    {"tried", r.tried},
                    {"unsupported", r.unsupported},
                    {"broken", r.broken},
                    {"outcomes", r.counts},
                    {"known", r.known},
                    {"failures", failures}});
  }
  json saved = json::array();
  for (const auto* all : {&result.corpus, &result.known}) {
    for (const ReplayedFailure& r : *all) {
      json& entry = saved.emplace_back(to_json(r.expected));
      entry["result"] = result_name(r.result);
      entry["now"] = r.now;
      entry["known"] = all == &result.known;
    }
  }
  return {{"schema", "touchstone-check-1"},
          {"candidate", result.candidate},
          {"seed", options.seed},
          {"count", options.count},
          {"groups", groups},
          {"tolerance", options.bar.tolerance},
          {"threshold", options.bar.threshold},
          {"laws", laws},
          {"corpus", saved}};
}

namespace {

std::string summit_text(double value) {
  return std::isinf(value) ? "no answer" : fmt::format("{:.1e}", value);
}

std::string goals_table(const std::vector<GoalResult>& goals, const Terminal& terminal) {
  constexpr std::size_t name_width = 26, numbers_width = 36;
  const TextTable table("pair and goal", std::min(name_width, terminal.columns - numbers_width),
                        {{"found", 9, 0}, {"sampled", 9, 1}, {"broken", 8, 0}, {"climbs", 8, 2}},
                        terminal);
  std::string text = table.headings();
  for (const GoalResult& r : goals) {
    if (!r.summit) continue;
    text += table.row(fmt::format("{} {}", pair_name(r.pair), goal_name(r.goal)),
                      {{summit_text(r.summit->value)},
                       {summit_text(r.summit->sampled)},
                       {fmt::format("{}", r.broken), r.broken > 0},
                       {fmt::format("{}", r.climbs)}});
  }
  Legend legend(table, terminal);
  return text + '\n' +
         legend
             .of("found",
                 "the largest, relative to the smaller size; of time, to the median of "
                 "what is sampled")
             .of("sampled", "the largest of the starts, which are drawn and not changed")
             .of("broken", "climbs that end where a law is broken")
             .text();
}

/// How to see the slowest configurations again; those of other goals that matter are failures.
std::string slowest_text(const std::vector<GoalResult>& goals, const std::string& candidate) {
  std::string text;
  for (const GoalResult& r : goals) {
    if (r.goal != Goal::time || !r.summit) continue;
    text += fmt::format("\n{}, slowest:\n  {}\n", pair_name(r.pair),
                        replay_command(r.summit->configuration, {candidate}));
  }
  return text;
}

}  // namespace

std::string search_text(const SearchResult& result, const std::string& candidate,
                        const Terminal& terminal) {
  std::string text = goals_table(result.goals, terminal);
  for (const Failure& f : result.failures) text += '\n' + failure_text(f, terminal);
  return text + slowest_text(result.goals, candidate);
}

}  // namespace touchstone
