#include "reports/check_report.hpp"

#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "oracle/truth.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/strict_json.hpp"
#include "reports/worst.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::string counts_text(const LawResult& result) {
  std::string text;
  for (const auto& [name, count] : result.counts) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
  }
  return text;
}

/// Numbers as in the answer's JSON.
std::string answer_text(const std::optional<ts_answer>& answer) {
  if (!answer) return "-";
  if (answer->status != TS_CONTACT) return status_name(answer->status);
  return fmt::format("signed distance {} m, normal {}, {} points",
                     or_null(answer->signed_distance).dump(), to_json(Vec3(answer->normal)).dump(),
                     answer->point_count);
}

/// The middle, rounded to nearest: -2 where bounds of 1e-30 lie about it.
double nearest(const oracle::Enclosure& e) {
  const mpq_class middle = (e.lo + e.hi) / 2;
  const double inside = middle.get_d();  // towards zero
  const double outside = std::nextafter(inside, middle < 0 ? -INFINITY : INFINITY);
  return abs(middle - inside) <= abs(middle - outside) ? inside : outside;
}

std::string failure_text(const Failure& f) {
  const oracle::Enclosure truth = oracle::truth(f.configuration).signed_distance;
  std::string text = fmt::format("{}, {}: {}\n", f.law, f.violation.failure, f.violation.detail);
  text += fmt::format("  {}\n", find_law(f.law).statement);
  text += fmt::format("  first met as {}; simplified:\n", f.identity);
  text += fmt::format("  {}\n  {}\n", to_json(f.configuration).dump(),
                      to_hex_json(f.configuration).dump());
  text += fmt::format("  truth: signed distance {} m\n", nearest(truth));
  text += fmt::format("  answer: {}\n", answer_text(f.answer));
  text += fmt::format("  echo '{}' | {} replay - --candidates {} --threshold {}\n",
                      to_hex_json(f.configuration).dump(), program_name({f.candidate}), f.candidate,
                      f.bar.threshold);
  return text;
}

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

const char* result_name(ReplayedFailure::Result result) {
  switch (result) {
    case ReplayedFailure::Result::as_expected:
      return "as expected";
    case ReplayedFailure::Result::fixed:
      return "fixed";
    case ReplayedFailure::Result::changed:
      return "changed";
    case ReplayedFailure::Result::skipped:
      return "skipped";
  }
  return "";
}

std::string corpus_name(const Failure& f) {
  return fmt::format("{}, {}, {}, {}{}{}", f.candidate, pair_name(pair_of(f.configuration)), f.law,
                     f.violation.failure, f.features.empty() ? "" : ", ", f.features);
}

}  // namespace

std::string check_text(const std::vector<LawResult>& results, const Terminal& terminal) {
  std::string text;
  const char* last = "";
  for (const LawResult& r : results) {
    const char* pair = pair_name(r.pair);
    if (pair != last) text += '\n' + terminal.heading(pair) + '\n';
    last = pair;
    const std::string verdict =
        r.broken == 0 ? terminal.good(fmt::format("{:<16}", "passed"))
                      : terminal.bad(fmt::format("{:<16}", fmt::format("broken by {}", r.broken)));
    text +=
        fmt::format("  {:<13}{:>6} tried  {} {}\n", r.law->name, r.tried, verdict, counts_text(r));
  }
  for (const LawResult& r : results) {
    if (r.failures.empty()) continue;
    text += fmt::format("\n{} {}", pair_name(r.pair), failure_text(r.failures.front()));
  }
  return text;
}

std::string corpus_text(const std::vector<ReplayedFailure>& corpus) {
  std::string text;
  for (const ReplayedFailure& r : corpus) {
    text += fmt::format("  {:<12} {}{}\n", result_name(r.result), corpus_name(r.expected),
                        r.now.empty() || r.result == ReplayedFailure::Result::as_expected
                            ? ""
                            : fmt::format(" ({})", r.now));
  }
  return text;
}

std::string junit_xml(const std::string& candidate, const std::vector<LawResult>& results,
                      const std::vector<ReplayedFailure>& corpus) {
  std::string cases;
  int failures = 0, skipped = 0;
  double seconds = 0;
  for (const LawResult& r : results) {
    seconds += r.seconds;
    cases += fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.3f}\">",
                         escaped(candidate), pair_name(r.pair), r.law->name, r.seconds);
    if (r.broken > 0) {
      ++failures;
      cases += fmt::format("<failure type=\"{}\" message=\"{}\">{}</failure>",
                           escaped(r.failures.front().violation.failure), escaped(counts_text(r)),
                           escaped(failure_text(r.failures.front())));
    }
    cases += "</testcase>\n";
  }
  for (const ReplayedFailure& r : corpus) {
    cases += fmt::format("    <testcase classname=\"{}.corpus\" name=\"{}\">",
                         escaped(r.expected.candidate), escaped(corpus_name(r.expected)));
    if (r.result == ReplayedFailure::Result::skipped) {
      ++skipped;
      cases += "<skipped/>";
    } else if (r.result != ReplayedFailure::Result::as_expected) {
      ++failures;
      cases +=
          fmt::format("<failure type=\"{}\">{}</failure>", result_name(r.result), escaped(r.now));
    }
    cases += "</testcase>\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"touchstone check\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" "
      "time=\"{:.3f}\">\n{}"
      "  </testsuite>\n</testsuites>\n",
      results.size() + corpus.size(), failures, skipped, seconds, cases);
}

std::string check_json(const std::string& candidate, const CheckOptions& options,
                       const std::vector<LawResult>& results,
                       const std::vector<ReplayedFailure>& corpus) {
  json laws = json::array(), saved = json::array();
  for (const LawResult& r : results) {
    json failures = json::array();
    for (const Failure& f : r.failures) failures.push_back(to_json(f));
    laws.push_back({{"law", r.law->name},
                    {"pair", pair_name(r.pair)},
                    {"tried", r.tried},
                    {"broken", r.broken},
                    {"outcomes", r.counts},
                    {"failures", failures}});
  }
  for (const ReplayedFailure& r : corpus) {
    json entry = to_json(r.expected);
    entry["result"] = result_name(r.result);
    entry["now"] = r.now;
    saved.push_back(entry);
  }
  const json result = {{"schema", "touchstone-check-1"},
                       {"candidate", candidate},
                       {"seed", options.seed},
                       {"count", options.count},
                       {"tolerance", options.bar.tolerance},
                       {"threshold", options.bar.threshold},
                       {"laws", laws},
                       {"corpus", saved}};
  return result.dump(2) + '\n';
}

}  // namespace touchstone
