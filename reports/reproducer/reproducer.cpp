// Templates are C++ with two additions: @name@ stands for a text, and a line that begins with
// [shape] or [shape,shape] is there only for these shapes of body B.
#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <functional>
#include <map>
#include <span>

#include "candidates/candidates.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/files/answer_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"

namespace touchstone {

// Made by the build from the files NAME.in.
extern const std::string_view head_template, question_template, judgement_template, bullet_template,
    ode_template, fcl_template, libccd_template, mujoco_template;

namespace {

using Texts = std::map<std::string, std::string, std::less<>>;

struct Engine {
  const char* name;
  const char* title;
  const char* candidate;
  const std::string_view& source;
  bool plane;  ///< it has a routine for the half-space
};

const std::array engines = {Engine{"bullet", "Bullet", "bullet", bullet_template, true},
                            Engine{"ode", "ODE", "ode", ode_template, true},
                            Engine{"fcl", "FCL", "fcl", fcl_template, true},
                            Engine{"libccd", "libccd", "libccd-gjk", libccd_template, false},
                            Engine{"mujoco", "MuJoCo", "mujoco", mujoco_template, true}};

const Engine& find_engine(std::string_view name, bool with_plane) {
  std::vector<std::string> names;
  for (const Engine& e : engines) {
    const bool able = e.plane || !with_plane;
    if (e.name == name && able) return e;
    if (able) names.emplace_back(e.name);
  }
  throw InvalidInput("--emit", fmt::format("\"{}\"", name),
                     fmt::format("must be one of {}{}", fmt::join(names, ", "),
                                 with_plane ? ", which know a half-space" : ""));
}

std::string hex(std::span<const double> numbers) {
  std::string text;
  for (const double x : numbers) text += (text.empty() ? "" : ", ") + fmt::format("{:a}", x);
  return text;
}

std::string hex(double x) { return fmt::format("{:a}", x); }

/// The numbers that the candidates are given, unit normals and quaternions in double.
Texts question(const Configuration& c) {
  const ts_shape a = to_ts_shape(c.a), b = to_ts_shape(c.b);
  const ts_pose pose_a = to_ts_pose(c.pose_a), pose_b = to_ts_pose(c.pose_b);
  return {{"shape_b", shape_name(c.b)},
          {"radius_a", hex(a.size[0])},
          {"half_length_a", hex(a.size[1])},
          {"position_a", hex(pose_a.position)},
          {"orientation_a", hex(pose_a.orientation)},
          {"radius_b", hex(b.size[0])},
          {"half_length_b", hex(b.size[1])},
          {"half_b", hex(std::span(b.size, 3))},
          {"normal_b", hex(std::span(b.size, 3))},
          {"displacement_b", hex(b.size[3])},
          {"position_b", hex(pose_b.position)},
          {"orientation_b", hex(pose_b.orientation)}};
}

/// The candidate's answer here and now, for a comment.
std::string seen(const Engine& engine, const Configuration& c, const oracle::Truth& truth,
                 const Bar& bar, const Limits& limits) {
  const Candidate* candidate = nullptr;
  try {
    candidate = &find_candidate(engine.candidate);
  } catch (const InvalidInput&) {
    return fmt::format("{} is not installed where this was written", engine.title);
  }
  const Answer answer = CandidateProcess(*candidate, bar.threshold, limits).answer(c);
  const Outcome outcome = score(c, truth, answer, bar).outcome;
  std::string text =
      fmt::format("{} {}: {}", engine.title, candidate->version, outcome_name(outcome));
  if (answer.status == TS_CONTACT)
    text += fmt::format(", signed distance {:.17g}", answer.signed_distance);
  return text;
}

bool names_shape(std::string_view list, std::string_view shape) {
  while (!list.empty()) {
    const auto comma = list.find(',');
    if (list.substr(0, comma) == shape) return true;
    list = comma == list.npos ? "" : list.substr(comma + 1);
  }
  return false;
}

/// The template's lines for this shape, without the brackets.
std::string lines_for(std::string_view shape, std::string_view source) {
  std::string result;
  while (!source.empty()) {
    const auto end = std::min(source.find('\n'), source.size() - 1) + 1;
    std::string_view line = source.substr(0, end);
    source.remove_prefix(end);
    if (line.front() == '[') {
      const auto close = line.find("] ");
      if (!names_shape(line.substr(1, close - 1), shape)) continue;
      line.remove_prefix(close + 2);
    }
    result += line;
  }
  return result;
}

/// With every @name@ replaced; what is put in is not searched again.
std::string filled(std::string_view source, const Texts& texts) {
  std::string result;
  for (;;) {
    const auto at = source.find('@');
    result += source.substr(0, at);
    if (at == source.npos) return result;
    const auto end = source.find('@', at + 1);
    result += texts.find(source.substr(at + 1, end - at - 1))->second;
    source.remove_prefix(end + 1);
  }
}

}  // namespace

std::vector<std::string> reproducer_engines() {
  std::vector<std::string> names;
  for (const Engine& e : engines) names.emplace_back(e.name);
  return names;
}

std::string reproducer(std::string_view name, const Configuration& c, const std::string& asked,
                       const Bar& bar, const Limits& limits) {
  const Engine& engine = find_engine(name, pair_of(c) == Pair::plane);
  const oracle::Truth truth = oracle::truth(c);
  const auto [low, high] = decimals(truth.signed_distance);
  const Vec3 n = truth.normals.front().n;
  const Vec3 middle = oracle::contact_patch(c, truth.normals.front()).centroid();
  Texts texts = question(c);
  texts.insert({{"engine", engine.title},
                {"asked", asked},
                {"truth_low", low},
                {"truth_high", high},
                {"true_distance", hex(truth.signed_distance.midpoint())},
                {"true_normal", hex(std::span(n.data(), 3))},
                {"middle", hex(std::span(middle.data(), 3))},
                {"tolerance", fmt::format("{}", bar.tolerance)},
                {"allowed", hex(bar.tolerance * error_size(c, bar))},
                {"threshold", hex(bar.threshold)},
                {"seen", seen(engine, c, truth, bar, limits)}});
  const std::string_view shape = shape_name(c.b);
  const auto part = [&](std::string_view source) {
    std::string text = filled(lines_for(shape, source), texts);
    return text.substr(0, text.find_last_not_of('\n') + 1);
  };
  texts["head"] = part(head_template);
  texts["question"] = part(question_template) + '\n';
  texts["judgement"] = part(judgement_template);
  return part(engine.source) + '\n';
}

}  // namespace touchstone
