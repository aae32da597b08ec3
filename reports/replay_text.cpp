// One configuration again, as a person reads it in a terminal.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "candidates/readable.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "reports/replay.hpp"
#include "reports/report_json.hpp"

namespace touchstone {
namespace {

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

/// For a column that ten letters fit into.
std::string in_four_digits(double x) { return std::isfinite(x) ? fmt::format("{:.4g}", x) : "-"; }

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

/// Of an engine that rounds the bodies in its way.
std::string roundings_text(const Answer& answer) {
  if (!answer.roundings) return "";
  const auto [of_a, of_b] = *answer.roundings;
  return fmt::format(" (a rounded by {:.6g} m, b by {:.6g} m)", of_a, of_b);
}

std::string answer_text(const ScoredAnswer& scored, const Terminal& terminal) {
  const auto& [candidate, answer, score] = scored;
  std::string text = terminal.folded(fmt::format(
      "{}: {}, {}", candidate, status_name(answer.status), outcome_name(score.outcome)));
  if (!answer.reason.empty()) text += terminal.below(answer.reason);
  if (score.model_error) {
    text += terminal.below(fmt::format("of what it models{}: error {}, of how it solves that: {}",
                                       roundings_text(answer), rounded(score.model_error),
                                       rounded(score.solver_error)));
  }
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

/// What a candidate makes of the configuration, and how far it is off.
std::string answer_row(const ScoredAnswer& scored, const TextTable& table) {
  const auto& [candidate, answer, score] = scored;
  const bool has_contact = answer.status == TS_CONTACT, is_right = score.outcome == Outcome::agree;
  const bool is_neither = score.outcome == Outcome::unsupported || score.outcome == Outcome::unseen;
  const std::string distance = has_contact                ? in_four_digits(answer.signed_distance)
                               : answer.status == TS_NONE ? "none"
                                                          : "-";  // the outcome says why
  return table.row(shown_name(candidate),
                   {{outcome_name(score.outcome), !is_right && !is_neither},
                    {distance},
                    {rounded(score.depth_error)},
                    {rounded(score.normal_regret)},
                    {has_contact ? fmt::format("{}", answer.point_count) : "-"},
                    {rounded(score.point_error)}},
                   is_right);
}

/// The truth and a row for each candidate.
std::string answers_table(const Examination& e, const Terminal& terminal) {
  std::size_t name_width = 0;
  for (const ScoredAnswer& a : e.answers) {
    if (shown_name(a.candidate) == a.candidate)
      name_width = std::max(name_width, a.candidate.size());
  }
  const TextTable table("candidate", name_width,
                        {{"outcome", 15, 0},
                         {"distance", 10, 1},
                         {"depth err", 9, 2},
                         {"regret", 8, 3},
                         {"pts", 3, 4},
                         {"off by", 8, 5}},
                        terminal);
  std::string text = table.headings();
  text += table.row(
      "truth",
      {{""}, {in_four_digits(nearest_to_middle(e.truth->signed_distance))}, {}, {}, {}, {}});
  for (const ScoredAnswer& a : e.answers) text += answer_row(a, table);
  Legend legend(table, terminal);
  return text + legend.of("distance", "signed, metres: negative inside")
                    .of("depth err", "relative to the smaller size, as are regret and off by")
                    .of("off by", "how much farther outside a body a point is than its depth")
                    .text();
}

/// The first normal and the patch along it, in a few digits.
std::string truth_in_short(const Examination& e, const Terminal& terminal) {
  const oracle::Truth& truth = *e.truth;
  if (truth.normals.empty()) return "";
  const Vec3& n = truth.normals.front().n;
  const auto kind = oracle::contact_patch(e.configuration, truth.normals.front()).kind();
  return terminal.folded(fmt::format("normal ({:.6g}, {:.6g}, {:.6g}), ties: {}; contact patch: {}",
                                     n.x(), n.y(), n.z(), ties_name(truth.ties),
                                     patch_kind_name(kind)));
}

std::string configuration_text(const Examination& e, const Terminal& terminal) {
  nlohmann::json line = to_json(e.configuration);
  line["id"] = e.id;
  return terminal.folded("configuration, a line for touchstone solve:") + line.dump() +
         "\nits exact fractions:\n" + to_exact_json(e.configuration).dump() + '\n' +
         terminal.folded("in hexadecimal, for touchstone solve too:") +
         to_hex_json(e.configuration).dump() + '\n';
}

}  // namespace

std::string replay_text(const Examination& e, const std::string& description, bool in_full,
                        const Terminal& terminal) {
  std::string text = escaped(e.id, Printed::one_line) + '\n';
  if (!description.empty()) text += terminal.folded(description);
  text += '\n' + answers_table(e, terminal);
  if (!in_full) {
    return text + truth_in_short(e, terminal) +
           terminal.folded("--candidates NAME prints all of its answer and of the truth.");
  }
  text += '\n' + truth_text(e.configuration, *e.truth, terminal) + '\n';
  for (const ScoredAnswer& answer : e.answers) text += answer_text(answer, terminal);
  return text + '\n' + configuration_text(e, terminal);
}

}  // namespace touchstone
