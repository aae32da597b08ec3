#include "properties/files/answer_json.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "oracle/patch/contact_patch.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/strict_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

double sign(Order order) { return order == Order::swapped ? -1 : 1; }

json vector_json(const double (&v)[3], double factor = 1) {
  return to_json(Vec3(factor * v[0], factor * v[1], factor * v[2]));
}

/// Digits that show an enclosure's ends apart: three more than they share, at least 20.
int digits_for(const oracle::Enclosure& e) {
  const double magnitude = std::max(std::abs(e.lo.get_d()), std::abs(e.hi.get_d()));
  const double width = e.width();
  if (!(magnitude > 0) || !(width > 0)) return 20;
  return std::clamp(3 + static_cast<int>(std::ceil(std::log10(magnitude) - std::log10(width))), 20,
                    400);
}

const char* kind_name(oracle::NormalFamily::Kind kind) {
  constexpr std::array names = {"circle", "arc", "curve"};
  return names[static_cast<std::size_t>(kind)];
}

/// An arc runs right-handed about its axis, whichever way the normals point.
json family_json(const oracle::NormalFamily& family, Order order) {
  json result = {{"kind", kind_name(family.kind)}};
  if (family.kind != oracle::NormalFamily::Kind::curve) result["axis"] = to_json(family.axis);
  if (family.kind == oracle::NormalFamily::Kind::arc) {
    result["ends"] = json::array();
    for (const Vec3& end : family.ends) result["ends"].push_back(to_json(Vec3(sign(order) * end)));
  }
  return result;
}

json patch_json(const oracle::ContactPatch& patch) {
  json outline = json::array();
  for (const Vec3& p : patch.outline()) outline.push_back(to_json(p));
  return {{"kind", patch_kind_name(patch.kind())},
          {"area", patch.area()},
          {"perimeter", patch.perimeter()},
          {"centroid", to_json(patch.centroid())},
          {"outline", outline}};
}

/// The members of a score that its JSON has, by their names.
template <class AnyScore>
auto numbers_of(AnyScore& score) {
  return std::array{std::pair("depth_error", &score.depth_error),
                    std::pair("normal_regret", &score.normal_regret),
                    std::pair("whole_regret", &score.whole_regret),
                    std::pair("normal_angle", &score.normal_angle),
                    std::pair("point_error", &score.point_error),
                    std::pair("deepest_error", &score.deepest_error),
                    std::pair("coverage", &score.coverage)};
}

/// JSON has no number for what is not finite: null, or one of these texts.
double number_or_nan(const json& value, const std::string& field) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (value == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (value == "inf") return infinity;
  if (value == "-inf") return -infinity;
  return number_or_null(value, field).value_or(std::numeric_limits<double>::quiet_NaN());
}

void read_vector(const json& value, const std::string& field, double (&v)[3]) {
  if (array(value, field).size() != 3) {
    throw InvalidInput(field, shown(value), "must be an array of 3 numbers");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    v[i] = number_or_nan(value[i], fmt::format("{}[{}]", field, i));
  }
}

/// The one of `all` whose name stands there.
template <class Values, class Value>
Value value_named(const json& name, const std::string& field, const Values& all,
                  const char* (*name_of)(Value), const char* must) {
  for (const Value value : all) {
    if (name == name_of(value)) return value;
  }
  throw InvalidInput(field, shown(name), must);
}

}  // namespace

const char* ties_name(oracle::Ties ties) {
  constexpr std::array names = {"unique", "finite", "continuum"};
  return names[static_cast<std::size_t>(ties)];
}

const char* patch_kind_name(oracle::ContactPatch::Kind kind) {
  constexpr std::array names = {"point", "segment", "region"};
  return names[static_cast<std::size_t>(kind)];
}

std::array<std::string, 2> decimals(const oracle::Enclosure& e) {
  const int digits = digits_for(e);
  return {oracle::decimal_below(e.lo, digits), oracle::decimal_above(e.hi, digits)};
}

json to_json(const Configuration& c, const oracle::Truth& truth, Order order) {
  json normals = json::array(), patch = json::array(), families = json::array();
  for (const auto& normal : truth.normals) {
    normals.push_back(to_json(Vec3(sign(order) * normal.n)));
    patch.push_back(patch_json(oracle::contact_patch(c, normal)));
  }
  for (const auto& family : truth.families) families.push_back(family_json(family, order));
  return {{"signed_distance", decimals(truth.signed_distance)},
          {"normals", normals},
          {"ties", ties_name(truth.ties)},
          {"families", families},
          {"patch", patch}};
}

json to_json(const ts_answer& answer, const Score& score, Order order) {
  const bool is_contact = answer.status == TS_CONTACT;
  json points = json::array();
  for (int i = 0; is_contact && i < answer.point_count; ++i) {
    const ts_point& p = answer.points[i];
    points.push_back({{"position", vector_json(p.position)},
                      {"normal", vector_json(p.normal, sign(order))},
                      {"depth", or_null(p.depth)}});
  }
  json score_json = {{"outcome", outcome_name(score.outcome)}};
  for (const auto& [name, value] : numbers_of(score)) score_json[name] = or_null(*value);
  return {{"status", status_name(answer.status)},
          {"signed_distance", is_contact ? or_null(answer.signed_distance) : json(nullptr)},
          {"normal", is_contact ? vector_json(answer.normal, sign(order)) : json(nullptr)},
          {"points", points},
          {"score", score_json}};
}

json to_json(const Answer& answer, const Score& score, Order order) {
  json result = to_json(static_cast<const ts_answer&>(answer), score, order);
  if (!answer.reason.empty()) result["reason"] = answer.reason;
  if (answer.roundings) {
    const auto [of_a, of_b] = *answer.roundings;
    result["roundings"] = order == Order::swapped ? std::array{of_b, of_a} : std::array{of_a, of_b};
  }
  if (score.model_error && score.solver_error) {
    result["score"]["model_error"] = *score.model_error;
    result["score"]["solver_error"] = *score.solver_error;
  }
  return result;
}

ts_answer answer_from_json(const json& value, const std::string& path) {
  const std::string prefix = path.empty() ? "" : path + '.';
  ts_answer answer{};
  answer.status = value_named(
      member(value, "status", path), prefix + "status",
      std::array{TS_CONTACT, TS_NONE, TS_UNSUPPORTED, TS_FAILED, TS_CRASHED, TS_TIMED_OUT},
      status_name, "must be a status that an answer has, as \"contact\"");
  if (answer.status != TS_CONTACT) return answer;
  answer.signed_distance =
      number_or_nan(member(value, "signed_distance", path), prefix + "signed_distance");
  read_vector(member(value, "normal", path), prefix + "normal", answer.normal);
  const json& points = array(member(value, "points", path), prefix + "points");
  if (points.size() > std::size(answer.points)) {
    throw InvalidInput(prefix + "points", fmt::format("{} of them", points.size()),
                       fmt::format("must be at most {}", std::size(answer.points)));
  }
  for (const json& point : points) {
    const std::string at = fmt::format("{}points[{}]", prefix, answer.point_count);
    require_object(point, at);
    ts_point& p = answer.points[answer.point_count++];
    read_vector(member(point, "position", at), at + ".position", p.position);
    if (point.contains("normal")) {
      read_vector(point["normal"], at + ".normal", p.normal);
    } else {
      std::copy(std::begin(answer.normal), std::end(answer.normal), p.normal);
    }
    p.depth = number_or_nan(member(point, "depth", at), at + ".depth");
  }
  return answer;
}

Score score_from_json(const json& answer, const std::string& answer_path) {
  const std::string path = answer_path + ".score";
  const json& value = member(answer, "score", answer_path);
  require_object(value, path);
  Score score;
  score.outcome = value_named(member(value, "outcome", path), path + ".outcome", all_outcomes,
                              outcome_name, "must be one that a score has");
  for (const auto& [name, number] : numbers_of(score)) {
    if (value.contains(name)) *number = number_or_null(value[name], path + "." + name);
  }
  return score;
}

}  // namespace touchstone
