#include "cli/failure_text.hpp"

#include <cmath>
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "oracle/truth.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/given_text.hpp"
#include "reports/replay.hpp"

namespace touchstone {
namespace {

/// As in the answer's JSON, which has no word for what is not finite.
std::string number_text(double x) {
  return std::isfinite(x) ? nlohmann::json(x).dump()
         : std::isnan(x)  ? "nan"
         : x > 0          ? "inf"
                          : "-inf";
}

std::string answer_text(const std::optional<ts_answer>& answer) {
  if (!answer) return "-";
  if (answer->status != TS_CONTACT) return status_name(answer->status);
  const double* const n = answer->normal;
  return fmt::format("signed distance {} m, normal [{},{},{}], {}",
                     number_text(answer->signed_distance), number_text(n[0]), number_text(n[1]),
                     number_text(n[2]), counted(answer->point_count, "point"));
}

/// The middle, rounded to nearest: -2 where bounds of 1e-30 lie about it.
double rounded_middle(const oracle::Enclosure& e) {
  const mpq_class middle = (e.lo + e.hi) / 2;
  const double inside = middle.get_d();  // towards zero
  const double outside = std::nextafter(inside, middle < 0 ? -INFINITY : INFINITY);
  return abs(middle - inside) <= abs(middle - outside) ? inside : outside;
}

}  // namespace

std::string failure_text(const Failure& f, const Terminal& terminal) {
  const oracle::Enclosure truth = oracle::truth(f.configuration).signed_distance;
  std::string text =
      terminal.folded(fmt::format("{} {}, {}: {}", pair_name(pair_of(f.configuration)), f.law,
                                  f.violation.failure, f.violation.detail));
  text += terminal.below(find_law(f.law).statement);
  const auto group = group_met(f);
  text += terminal.below(fmt::format("first met{} as {}; simplified:",
                                     group ? fmt::format(" in {} poses", group_name(*group)) : "",
                                     f.identity));
  text += fmt::format("  {}\n  {}\n", to_json(f.configuration).dump(),
                      to_hex_json(f.configuration).dump());
  text += terminal.below(fmt::format("truth: signed distance {} m", rounded_middle(truth)));
  text += terminal.below("answer: " + answer_text(f.answer));
  text += fmt::format("  echo '{}' | {} replay - --candidates {} --threshold {}\n",
                      to_hex_json(f.configuration).dump(), program_name({f.candidate}), f.candidate,
                      f.bar.threshold);
  return text;
}

}  // namespace touchstone
