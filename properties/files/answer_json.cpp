#include "properties/files/answer_json.hpp"

#include <algorithm>
#include <cmath>

#include "oracle/patch/contact_patch.hpp"
#include "properties/files/configuration_json.hpp"

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

const char* kind_name(oracle::ContactPatch::Kind kind) {
  switch (kind) {
    case oracle::ContactPatch::Kind::point:
      return "point";
    case oracle::ContactPatch::Kind::segment:
      return "segment";
    case oracle::ContactPatch::Kind::region:
      return "region";
  }
  return "";
}

const char* kind_name(oracle::NormalFamily::Kind kind) {
  switch (kind) {
    case oracle::NormalFamily::Kind::circle:
      return "circle";
    case oracle::NormalFamily::Kind::arc:
      return "arc";
    case oracle::NormalFamily::Kind::curve:
      return "curve";
  }
  return "";
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
  return {{"kind", kind_name(patch.kind())},
          {"area", patch.area()},
          {"perimeter", patch.perimeter()},
          {"centroid", to_json(patch.centroid())},
          {"outline", outline}};
}

}  // namespace

json to_json(const Configuration& c, const oracle::Truth& truth, Order order) {
  const auto& [lo, hi] = truth.signed_distance;
  const int digits = digits_for(truth.signed_distance);
  json normals = json::array(), patch = json::array(), families = json::array();
  for (const auto& normal : truth.normals) {
    normals.push_back(to_json(Vec3(sign(order) * normal.n)));
    patch.push_back(patch_json(oracle::contact_patch(c, normal)));
  }
  for (const auto& family : truth.families) families.push_back(family_json(family, order));
  return {
      {"signed_distance", {oracle::decimal_below(lo, digits), oracle::decimal_above(hi, digits)}},
      {"normals", normals},
      {"ties", ties_name(truth.ties)},
      {"families", families},
      {"patch", patch}};
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
            {"point_error", number(score.point_error)},
            {"deepest_error", number(score.deepest_error)},
            {"coverage", number(score.coverage)}}}};
}

}  // namespace touchstone
