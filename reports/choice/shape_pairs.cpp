#include "reports/choice/shape_pairs.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>

#include "candidates/candidates.hpp"
#include "candidates/host/progress.hpp"
#include "properties/features.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/write_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/machine.hpp"
#include "reports/report_json.hpp"
#include "simulation/scenes/choose.hpp"
#include "simulation/scenes/replayed.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// Sampled overlaps: relative to the smaller size, or to the need if that is more, so that a model
/// that misses them is found out.
constexpr double least_depth = 1e-4, most_depth = 0.05, most_of_need = 4;

/// Two shapes and how often the file has them.
struct ShapePair {
  Cylinder a;
  Shape b;
  std::string name, example;
  int count = 1;
};

bool can_touch(const ShapesFile& file, const PlacedShape& x, const PlacedShape& y) {
  if (x.link == y.link || (x.fixed && y.fixed)) return false;
  return !file.joined.contains({x.link, y.link}) && !file.joined.contains({y.link, x.link});
}

std::vector<ShapePair> shape_pairs(const ShapesFile& file) {
  std::vector<ShapePair> result;
  for (std::size_t i = 0; i < file.shapes.size(); ++i) {
    for (std::size_t j = i + 1; j < file.shapes.size(); ++j) {
      const PlacedShape *a = &file.shapes[i], *b = &file.shapes[j];
      if (!can_touch(file, *a, *b)) continue;
      if (!std::holds_alternative<Cylinder>(a->shape)) std::swap(a, b);
      if (!std::holds_alternative<Cylinder>(a->shape)) continue;
      std::string first = shape_text(a->shape), second = shape_text(b->shape);
      if (std::holds_alternative<Cylinder>(b->shape) && second < first) {
        std::swap(a, b);
        std::swap(first, second);
      }
      const std::string name = first + " on " + second;
      const auto known = std::find_if(result.begin(), result.end(),
                                      [&](const ShapePair& p) { return p.name == name; });
      if (known != result.end()) {
        ++known->count;
        continue;
      }
      result.push_back({std::get<Cylinder>(a->shape), b->shape, name, a->name + " and " + b->name});
    }
  }
  return result;
}

std::vector<Configuration> sample(const ShapePair& shapes, std::uint64_t number,
                                  const PairNeeds& needs) {
  Draw draw(rc::Random({needs.seed, number, 0, 0}));
  const Pair pair = pair_of({shapes.a, {}, shapes.b, {}});
  std::vector<Configuration> result;
  for (std::uint64_t i = 0; i < needs.count; ++i) {
    const Bodies bodies{shapes.a, draw.orientation(), shapes.b, draw.orientation()};
    const FeaturePair features = draw_feature_pair(draw, pair);
    const double size = smaller_size(bodies);
    const double most = std::min(size, std::max(most_depth * size, most_of_need * needs.depth));
    const double depth = draw.log_uniform(least_depth * size, most);
    result.push_back(meet(draw, bodies, features.on_a, features.on_b, -depth));
  }
  return result;
}

bool serves(const Replayed& r, const PairNeeds& needs) {
  return r.nanoseconds && r.depth_error <= needs.depth && r.normal_angle <= needs.angle;
}

json finite(double x) { return std::isfinite(x) ? json(x) : json(nullptr); }

/// Candidates on one pair, the cheapest first; those that cannot be timed are left out.
json candidates_json(const std::vector<Replayed>& replayed,
                     const std::vector<const Candidate*>& candidates,
                     const std::vector<Configuration>& sampled, const PairNeeds& needs,
                     const std::string& file) {
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (replayed[c].nanoseconds) order.push_back(c);
  }
  std::sort(order.begin(), order.end(), [&](std::size_t x, std::size_t y) {
    return *replayed[x].nanoseconds < *replayed[y].nanoseconds;
  });
  json result = json::array();
  for (const std::size_t c : order) {
    const Replayed& r = replayed[c];
    json entry = {{"name", candidates[c]->name},
                  {"nanoseconds", *r.nanoseconds},
                  {"count", r.count},
                  {"agree", r.agree},
                  {"depth_error", finite(r.depth_error)},
                  {"normal_angle", r.normal_angle},
                  {"serves", serves(r, needs)},
                  {"worst", nullptr}};
    if (!serves(r, needs)) {
      const bool deep = !(r.depth_error <= needs.depth);
      std::string name = candidates[c]->name;
      std::replace(name.begin(), name.end(), ':', '-');
      const std::string at = fmt::format("{}-{}.json", file, name);
      entry["worst"] = {
          {"configuration", to_json(sampled[deep ? r.deepest_error : r.widest_angle])},
          {"file", at},
          {"replay",
           fmt::format("touchstone replay {} --candidates reference,{}", at, candidates[c]->name)}};
    }
    result.push_back(entry);
  }
  return result;
}

/// The cheapest that serves; the exact one unless another is cheaper by more than the machine's
/// noise.
json chosen_of(const json& candidates) {
  const auto exact = std::find_if(candidates.begin(), candidates.end(),
                                  [](const json& c) { return c["name"] == "reference"; });
  const double limit = exact != candidates.end() && (*exact)["serves"] == true
                           ? cheaper_share * (*exact)["nanoseconds"].get<double>()
                           : std::numeric_limits<double>::infinity();
  for (const json& c : candidates) {
    if (c["serves"] == true && c["nanoseconds"].get<double>() < limit) return c;
  }
  return exact != candidates.end() && (*exact)["serves"] == true ? *exact : json(nullptr);
}

/// A robot's name as part of a file's.
std::string file_name(std::string name) {
  constexpr std::size_t max_length = 100;
  name.resize(std::min(name.size(), max_length));
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.';
  };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !is_plain(c); }, '-');
  return name;
}

}  // namespace

json choose_for_pairs(const ShapesFile& file, const PairNeeds& needs,
                      const std::vector<const Candidate*>& given, const Limits& limits,
                      const std::string& command, const std::string& folder) {
  const auto pairs = shape_pairs(file);
  if (pairs.empty()) {
    throw InvalidInput("scene", '"' + file.name + '"',
                       "must hold a cylinder and another collision shape that it can touch: of "
                       "another link without a joint between them");
  }
  std::vector<const Candidate*> candidates = {&find_candidate("reference")};
  for (const Candidate* c : given) {
    if (c != candidates[0]) candidates.push_back(c);
  }
  auto processes = start(candidates, simulation_threshold, limits);
  Progress progress("pairs of shapes", pairs.size());
  json entries = json::array();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto sampled = sample(pairs[i], i, needs);
    const std::string at = fmt::format("{}/{}-{}", folder, file_name(file.name), i + 1);
    const json all = candidates_json(replay(sampled, processes), candidates, sampled, needs, at);
    entries.push_back({{"name", pairs[i].name},
                       {"example", pairs[i].example},
                       {"count", pairs[i].count},
                       {"chosen", chosen_of(all)},
                       {"candidates", all}});
    progress.update(i + 1);
  }
  return {{"schema", "touchstone-pair-choice-1"},
          {"command", command},
          {"machine", to_json(describe_machine())},
          {"name", file.name},
          {"shapes", file.shapes.size()},
          {"ignored", file.ignored},
          {"needs",
           {{"depth", needs.depth},
            {"angle", needs.angle},
            {"count", needs.count},
            {"seed", needs.seed}}},
          {"pairs", entries}};
}

void write_pair_evidence(const json& choice) {
  for (const json& pair : choice["pairs"]) {
    for (const json& c : pair["candidates"]) {
      if (c["worst"].is_null()) continue;
      const std::filesystem::path at = c["worst"]["file"].get<std::string>();
      check_writable(at.parent_path());
      write_file(at, c["worst"]["configuration"].dump() + '\n', "--out");
    }
  }
}

std::string pairs_text(const json& choice) {
  const auto text = [](const json& value) { return value.get<std::string>(); };
  const auto errors = [](const json& c) {
    if (c["depth_error"].is_null()) return std::string("some without an answer");
    return fmt::format("depth off by up to {:.2g} m, normals by {:.2g}°",
                       c["depth_error"].get<double>(), c["normal_angle"].get<double>());
  };
  std::string lines = fmt::format(
      "{}: {} collision shapes, {} kinds of pairs with a cylinder\n"
      "Needs: depth within {:g} m, normals within {:g}°, on {} sampled poses of each\n",
      text(choice["name"]), choice["shapes"].get<std::size_t>(), choice["pairs"].size(),
      choice["needs"]["depth"].get<double>(), choice["needs"]["angle"].get<double>(),
      choice["needs"]["count"].get<std::size_t>());
  for (const json& pair : choice["pairs"]) {
    lines += fmt::format(
        "\n{} ({}{})\n", text(pair["name"]),
        pair["count"] == 1 ? "" : fmt::format("{} pairs, as ", pair["count"].get<int>()),
        text(pair["example"]));
    if (pair["chosen"].is_null()) {
      lines += "  no candidate serves\n";
    } else {
      const json& c = pair["chosen"];
      lines += fmt::format("  {}, {:.0f} ns: {}\n",
                           c["name"] == "reference" ? "the exact cylinder" : text(c["name"]),
                           c["nanoseconds"].get<double>(), errors(c));
    }
    for (const json& c : pair["candidates"]) {
      if (c["name"] != "capsule" || c["serves"] == true) continue;
      lines += fmt::format("  capsule, {:.0f} ns, fails: {}\n    {}\n",
                           c["nanoseconds"].get<double>(), errors(c), text(c["worst"]["replay"]));
    }
  }
  return lines;
}

}  // namespace touchstone
