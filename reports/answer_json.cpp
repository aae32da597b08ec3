#include "reports/answer_json.hpp"

#include <algorithm>
#include <cmath>

#include "reports/configuration_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

const char* ties_name(oracle::Ties ties) {
  switch (ties) {
    case oracle::Ties::unique:
      return "unique";
    case oracle::Ties::finite:
      return "finite";
    case oracle::Ties::continuum:
      return "continuum";
  }
  return "";
}

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }
json number(const std::optional<double>& value) { return value ? number(*value) : json(nullptr); }

double sign(Order order) { return order == Order::swapped ? -1 : 1; }

json vector(const double (&v)[3], double factor = 1) {
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

}  // namespace

json to_json(const oracle::Truth& truth, Order order) {
  const auto& [lo, hi] = truth.signed_distance;
  const int digits = digits_for(truth.signed_distance);
  json normals = json::array();
  for (const auto& normal : truth.normals) {
    normals.push_back(to_json(Vec3(sign(order) * normal.n)));
  }
  return {
      {"signed_distance", {oracle::decimal_below(lo, digits), oracle::decimal_above(hi, digits)}},
      {"normals", normals},
      {"ties", ties_name(truth.ties)}};
}

json to_json(const ts_answer& answer, const Score& score, Order order) {
  const bool contact = answer.status == TS_CONTACT;
  json points = json::array();
  for (int i = 0; contact && i < answer.point_count; ++i) {
    const ts_point& p = answer.points[i];
    points.push_back({{"position", vector(p.position)},
                      {"normal", vector(p.normal, sign(order))},
                      {"depth", number(p.depth)}});
  }
  return {{"status", status_name(answer.status)},
          {"signed_distance", contact ? number(answer.signed_distance) : json(nullptr)},
          {"normal", contact ? vector(answer.normal, sign(order)) : json(nullptr)},
          {"points", points},
          {"score",
           {{"outcome", outcome_name(score.outcome)},
            {"depth_error", number(score.depth_error)},
            {"normal_regret", number(score.normal_regret)},
            {"normal_angle", number(score.normal_angle)},
            {"coverage", nullptr}}}};
}

}  // namespace touchstone
