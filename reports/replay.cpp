#include "reports/replay.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <numeric>
#include <utility>

#include <nlohmann/json.hpp>

#include "candidates/candidates.hpp"
#include "candidates/readable.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/pages/page.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

std::string coordinate(double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : "nan"; }

/// After a label; components that do not fit beside it stand on lines of their own.
std::string vector_line(const std::string& label, const Vec3& v, const Terminal& terminal) {
  const std::string text =
      fmt::format("({}, {}, {})", coordinate(v.x()), coordinate(v.y()), coordinate(v.z()));
  return label +
         wrapped(text, terminal.columns - label.size() - 1,
                 '\n' + std::string(label.size() + 1, ' ')) +
         '\n';
}

std::string number_or_dash(double x) { return std::isfinite(x) ? fmt::format("{:.17g}", x) : "-"; }

std::string rounded(const std::optional<double>& x) {
  return x && std::isfinite(*x) ? fmt::format("{:.3g}", *x) : "-";
}

/// In colour, padded to this width.
std::string outcome_text(Outcome outcome, int width, const Terminal& terminal) {
  const std::string text = fmt::format("{:<{}}", outcome_name(outcome), width);
  if (outcome == Outcome::agree) return terminal.good(text);
  const bool is_neither = outcome == Outcome::unsupported || outcome == Outcome::unseen;
  return is_neither ? text : terminal.bad(text);
}

/// One line for each candidate: what it makes of the configuration, and how far it is off. On a
/// terminal that is too narrow for the line, three.
std::string overview(const std::vector<ScoredAnswer>& answers, const Terminal& terminal) {
  constexpr std::size_t table_width = 79;
  const bool has_room = terminal.columns >= table_width;
  std::string text;
  if (has_room) {
    text =
        terminal.heading(fmt::format("{:<23} {:<7} {:<15} {:>9} {:>8} {:>3} {:>8}", "candidate",
                                     "answer", "outcome", "depth err", "regret", "pts", "off by")) +
        '\n';
  }
  for (const auto& [candidate, answer, score] : answers) {
    const bool has_contact = answer.status == TS_CONTACT;
    // Without either the outcome says why.
    const bool has_answered = has_contact || answer.status == TS_NONE;
    const std::string status = has_answered ? status_name(answer.status) : "-";
    const std::string depth_error = rounded(score.depth_error),
                      regret = rounded(score.normal_regret),
                      points = has_contact ? fmt::format("{}", answer.point_count) : "-",
                      off = rounded(score.point_error);
    if (has_room) {
      text +=
          fmt::format("{:<23} {:<7} {} {:>9} {:>8} {:>3} {:>8}\n", candidate, status,
                      outcome_text(score.outcome, 15, terminal), depth_error, regret, points, off);
    } else {
      text += fmt::format("{}\n  answer {}, outcome {}\n", candidate, status,
                          outcome_text(score.outcome, 0, terminal));
      text += terminal.below(fmt::format("depth err {}, regret {}, points {}, off by {}",
                                         depth_error, regret, points, off));
    }
  }
  return text +
         terminal.folded(
             "Errors are relative to the smaller size; \"off by\" is how much farther outside "
             "a body a point is than its depth.");
}

std::string patch_text(const oracle::ContactPatch& patch, const Terminal& terminal) {
  using Kind = oracle::ContactPatch::Kind;
  std::string text = patch_kind_name(patch.kind());
  if (patch.kind() == Kind::segment) text += " of length " + rounded(patch.perimeter());
  if (patch.kind() == Kind::region) text += " of area " + rounded(patch.area());
  return fmt::format("    patch: {} about\n{}", text,
                     vector_line("    ", patch.centroid(), terminal));
}

std::string truth_text(const Configuration& c, const oracle::Truth& truth,
                       const Terminal& terminal) {
  const auto [low, high] = decimals(truth.signed_distance);
  std::string text = fmt::format("truth: signed distance between\n  {}\n  {}\n  ties: {}\n", low,
                                 high, ties_name(truth.ties));
  for (const auto& normal : truth.normals) {
    text += vector_line("  normal ", normal.n, terminal) +
            patch_text(oracle::contact_patch(c, normal), terminal);
  }
  return text;
}

std::string answer_text(const ScoredAnswer& scored, const Terminal& terminal) {
  const auto& [candidate, answer, score] = scored;
  std::string text = terminal.folded(fmt::format(
      "{}: {}, {}", candidate, status_name(answer.status), outcome_name(score.outcome)));
  if (!answer.reason.empty()) text += terminal.below(answer.reason);
  if (answer.status != TS_CONTACT) return text;
  text += terminal.below("signed distance " + number_or_dash(answer.signed_distance)) +
          vector_line("  normal ", Vec3(answer.normal), terminal);
  text += terminal.below(
      fmt::format("depth error {}, normal regret {} (of the whole bodies {}), angle {} deg",
                  rounded(score.depth_error), rounded(score.normal_regret),
                  rounded(score.whole_regret), rounded(score.normal_angle)));
  text +=
      terminal.below(fmt::format("coverage {} of the contact patch, points outside a body by {}",
                                 rounded(score.coverage), rounded(score.point_error)));
  text += terminal.below("deepest point's error " + rounded(score.deepest_error));
  for (int i = 0; i < answer.point_count; ++i) {
    const ts_point& p = answer.points[i];
    text += vector_line("  point ", Vec3(p.position), terminal) +
            fmt::format("    depth {}\n", number_or_dash(p.depth));
  }
  return text;
}

}  // namespace

std::string replay_text(const Examination& e, const std::string& description,
                        const Terminal& terminal) {
  json line = to_json(e.configuration);
  line["id"] = e.id;
  std::string text = escaped(e.id, Printed::one_line) + '\n';
  if (!description.empty()) text += terminal.folded(description);
  text += '\n' + overview(e.answers, terminal) + '\n' +
          truth_text(e.configuration, *e.truth, terminal) + '\n';
  for (const ScoredAnswer& answer : e.answers) text += answer_text(answer, terminal);
  return text + '\n' + terminal.folded("configuration, a line for touchstone solve:") +
         line.dump() + "\nits exact fractions:\n" + to_exact_json(e.configuration).dump() + '\n' +
         terminal.folded("in hexadecimal, for touchstone solve too:") +
         to_hex_json(e.configuration).dump() + '\n';
}

std::string replay_json(const Examination& examination) {
  return to_json(examination).dump() + '\n';
}

double nearest_to_middle(const oracle::Enclosure& e) {
  const mpq_class middle = (e.lo + e.hi) / 2;
  const double inner = middle.get_d();  // towards zero
  const double outer = std::nextafter(inner, middle < 0 ? -INFINITY : INFINITY);
  return abs(middle - inner) <= abs(middle - outer) ? inner : outer;
}

json with_candidates(json data, const std::map<std::string, std::string>& runs) {
  data["program"] = program_name({});
  data["marks"] = json::object();
  for (const auto& [name, how] : runs) {
    const Mark mark = mark_of(name);
    data["marks"][name] = {mark.colour, mark.symbol};
    if (how != "native") data["runs"][name] = how;
    // Needs an option before it is known.
    const std::string program = program_name({name});
    if (program != data["program"]) data["programs"][name] = program;
  }
  return data;
}

std::string replay_page(const Examination& examination, const std::string& description) {
  json data = to_json(examination);
  data["hexadecimal"] = to_hex_json(examination.configuration);
  data["exact"] = to_exact_json(examination.configuration);
  data["description"] = description;
  std::map<std::string, std::string> runs;
  for (const ScoredAnswer& answer : examination.answers) {
    runs[answer.candidate] = runs_as(answer.candidate);
  }
  return render_page(Page::replay, with_candidates(std::move(data), runs));
}

namespace {

std::string option_text(const Added& added) {
  return ' ' + added.option + ' ' + shell_quoted(added.value);
}

/// " --candidates a,b" if one of them is asked only when it is named; otherwise the default ones
/// are asked. " --all-candidates" for all that there are: a page has hundreds of these commands.
std::string choice_of(const std::vector<std::string>& candidates) {
  const std::vector<const Candidate*> usual = default_candidates();
  const bool is_special =
      std::any_of(candidates.begin(), candidates.end(), [&](const std::string& name) {
        const Candidate* const known = known_candidate(name);
        return known && std::find(usual.begin(), usual.end(), known) == usual.end();
      });
  if (!is_special) return "";
  if (std::ranges::equal(candidates, all_candidates(), {}, {}, &Candidate::name)) {
    return " --all-candidates";
  }
  std::string names;
  for (const std::string& name : candidates)
    names += (names.empty() ? "" : ",") + shell_quoted(name);
  return " --candidates " + names;
}

}  // namespace

Examination examine(const Subject& subject, std::span<CandidateProcess* const> candidates,
                    const Bar& bar, double width) {
  std::vector<std::string> names;
  for (const CandidateProcess* c : candidates) names.push_back(c->candidate().name);
  Examination result{subject.id.empty() ? subject.name : subject.id,
                     subject.configuration,
                     {},
                     {},
                     replay_command(subject, names)};
  const auto take = [&](const ScoredConfiguration& scored) {
    result.truth = scored.truth;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      result.answers.push_back(
          {candidates[k]->candidate().name, scored.answers[k], scored.scores[k]});
    }
  };
  score_configurations({&subject.configuration, 1}, candidates, bar, width, take);
  return result;
}

namespace {

/// As bash and zsh read what is not seen: $'left\xe2\x80\xaethgir'.
std::string dollar_quoted(const std::string& text) {
  std::string result = "$'";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_seen = byte >= 0x20 && byte < 0x7f;
    result += is_seen ? (c == '\'' || c == '\\' ? "\\" : "") + std::string(1, c)
                      : fmt::format("\\x{:02x}", byte);
  }
  return result + "'";
}

const char* started_as() { return is_in_clone() ? "./touchstone" : "touchstone"; }

}  // namespace

std::string shell_quoted(const std::string& text) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+@", c); };
  if (!text.empty() && std::all_of(text.begin(), text.end(), plain)) return text;
  if (escaped(text, Printed::one_line) != text) return dollar_quoted(text);
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

std::string program_name() {
  std::string name = started_as();
  for (const Added& added : added_candidates()) name += option_text(added);
  return name;
}

std::string program_name(const std::vector<std::string>& candidates) {
  std::vector<std::string> options;
  for (const std::string& name : candidates) {
    const Candidate* const known = known_candidate(name);
    if (!known || !known->added) continue;
    const std::string option = option_text(*known->added);
    if (std::find(options.begin(), options.end(), option) == options.end()) {
      options.push_back(option);
    }
  }
  return std::accumulate(options.begin(), options.end(), std::string(started_as()));
}

std::string replay_command(const std::string& name, const std::vector<std::string>& candidates) {
  return program_name(candidates) + " replay " + shell_quoted(name) + choice_of(candidates);
}

std::string replay_command(const Subject& subject, const std::vector<std::string>& candidates) {
  if (subject.name == standard_input_name) {
    return replay_command(subject.configuration, candidates);
  }
  return replay_command(subject.name, candidates) +
         (subject.id.empty() ? "" : " --id " + shell_quoted(subject.id));
}

std::string replay_command(const Configuration& configuration,
                           const std::vector<std::string>& candidates) {
  return "echo '" + to_json(configuration).dump() + "' | " + program_name(candidates) +
         " replay -" + choice_of(candidates);
}

}  // namespace touchstone
