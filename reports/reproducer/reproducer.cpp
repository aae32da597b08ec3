#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <map>
#include <span>
#include <string>

#include "candidates/candidates.hpp"
#include "candidates/npm_engines.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"

namespace touchstone {

// Made by the build from the files NAME.in of candidates/reproducers, and npm's package.json.
extern const std::string_view head_template, cpp_template, javascript_template, python_template;
extern const std::string_view bullet_template, ode_template, fcl_template, libccd_template,
    mujoco_template;
extern const std::string_view jolt_mjs_template, jolt_doctest_template, rapier_mjs_template,
    physx_mjs_template, havok_mjs_template, mujoco3_mjs_template, mujoco3_py_template,
    mjcf_template;
extern const std::string_view plugin_template, command_py_template;
extern const std::string_view package_json;

namespace {

// The texts that stand for the names in a template.

using Texts = std::map<std::string, std::string, std::less<>>;

/// How a language writes doubles to the last bit.
enum class NumberStyle { hexadecimal, decimal };

using Quaternion = std::array<double, 4>;  // w, x, y, z
using Vector = std::array<double, 3>;

/// Which quaternion turns an engine's axis into our z axis.
const Quaternion y_to_z = {M_SQRT1_2, M_SQRT1_2, 0, 0}, x_to_z = {M_SQRT1_2, 0, -M_SQRT1_2, 0};

// As in candidates/npm/packages.mjs, operation for operation, so that engines get the same bits.

Quaternion multiply(const double* p, const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {p[0] * w - p[1] * x - p[2] * y - p[3] * z, p[0] * x + p[1] * w + p[2] * z - p[3] * y,
          p[0] * y - p[1] * z + p[2] * w + p[3] * x, p[0] * z + p[1] * y - p[2] * x + p[3] * w};
}

Vector rotate(const double* q, const double* v) {
  const double w = q[0], x = q[1], y = q[2], z = q[3], a = v[0], b = v[1], c = v[2];
  const double s = 2 * (y * c - z * b), t = 2 * (z * a - x * c), u = 2 * (x * b - y * a);
  return {a + w * s + y * u - z * t, b + w * t + z * s - x * u, c + w * u + x * t - y * s};
}

/// A rotation that turns one unit vector into another.
Quaternion turn(const Vector& from, const double* to) {
  const auto [a, b, c] = from;
  const double w = 1 + a * to[0] + b * to[1] + c * to[2];
  Quaternion q = {w, b * to[2] - c * to[1], c * to[0] - a * to[2], a * to[1] - b * to[0]};
  if (w < 1e-9) {  // opposite: half a turn about anything across
    q = std::abs(a) < 0.8 ? Quaternion{0, 0, c, -b} : Quaternion{0, -c, 0, a};
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& x : q) x /= length;
  return q;
}

/// The shortest decimals that give the same number; zero keeps its sign in Python, too.
std::string decimal(double x) { return x == 0 && std::signbit(x) ? "-0.0" : fmt::format("{}", x); }

std::string single(double x) {
  const std::string text = fmt::format("{}", static_cast<float>(x));
  return text + (text.find_first_of(".e") == text.npos ? ".0f" : "f");
}

std::string hexadecimal(double x) { return fmt::format("{:a}", x); }

class Writer {
 public:
  explicit Writer(NumberStyle numbers) : numbers_(numbers) {}

  /// As the language writes it; for C++ with floats also, as "name_float", and for MJCF with spaces
  /// alone, as "name_xml".
  void put(const std::string& name, std::span<const double> values) {
    std::vector<std::string> own, floats, decimals;
    for (const double x : values) {
      own.push_back(numbers_ == NumberStyle::hexadecimal ? hexadecimal(x) : decimal(x));
      floats.push_back(single(x));
      decimals.push_back(decimal(x));
    }
    texts[name] = fmt::format("{}", fmt::join(own, ", "));
    texts[name + "_float"] = fmt::format("{}", fmt::join(floats, ", "));
    texts[name + "_xml"] = fmt::format("{}", fmt::join(decimals, " "));
  }
  void put(const std::string& name, double value) { put(name, {&value, 1}); }

  /// A rotation, x, y, z, w, as engines take it.
  void put_xyzw(const std::string& name, const Quaternion& q) {
    put(name, std::array{q[1], q[2], q[3], q[0]});
  }

  Texts texts;

 private:
  NumberStyle numbers_;
};

/// Where engines have their half-spaces: through the origin of a frame of their own.
void put_plane(Writer& writer, const ts_shape& plane, const ts_pose& pose) {
  const Vector up = rotate(pose.orientation, plane.size);
  Vector point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = pose.position[i] + plane.size[3] * up[i];
  writer.put("plane_point", point);
  writer.put_xyzw("plane_along_x", multiply(pose.orientation, turn({1, 0, 0}, plane.size)));
  writer.put("plane_along_z", multiply(pose.orientation, turn({0, 0, 1}, plane.size)));
}

/// The numbers that the candidates are given (unit normals and quaternions in double), and what
/// engines with other axes get.
Texts question_texts(const Configuration& c, NumberStyle numbers) {
  const ts_shape a = to_ts_shape(c.a), b = to_ts_shape(c.b);
  const ts_pose pose_a = to_ts_pose(c.pose_a), pose_b = to_ts_pose(c.pose_b);
  Writer writer(numbers);
  writer.put("radius_a", a.size[0]);
  writer.put("half_length_a", a.size[1]);
  writer.put("radius_b", b.size[0]);
  writer.put("half_length_b", b.size[1]);
  writer.put("half_b", std::span(b.size, 3));
  writer.put("normal_b", std::span(b.size, 3));
  writer.put("displacement_b", b.size[3]);
  writer.put("constant_b", -b.size[3]);
  for (const auto& [body, pose] : {std::pair("a", pose_a), std::pair("b", pose_b)}) {
    const std::string name = body;
    const double* const q = pose.orientation;
    writer.put("position_" + name, pose.position);
    writer.put("orientation_" + name, pose.orientation);
    writer.put_xyzw("xyzw_" + name, {q[0], q[1], q[2], q[3]});
    writer.put_xyzw(name + "_along_y", multiply(q, y_to_z));
    writer.put_xyzw(name + "_along_x", multiply(q, x_to_z));
  }
  if (b.kind == TS_PLANE) put_plane(writer, b, pose_b);
  std::string shape = shape_name(c.b);
  writer.texts["shape_b"] = shape;
  shape[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(shape[0])));
  writer.texts["Shape_b"] = shape;
  return writer.texts;
}

/// The truth, and what is allowed.
Texts truth_texts(const Configuration& c, const oracle::Truth& truth, const Bar& bar,
                  NumberStyle numbers) {
  const auto [low, high] = decimals(truth.signed_distance);
  const double distance = truth.signed_distance.midpoint();
  const Vec3 n = truth.normals.front().n;
  const Vec3 middle = oracle::contact_patch(c, truth.normals.front()).centroid();
  Writer writer(numbers);
  writer.put("true_distance", distance);
  writer.put("true_depth", -distance);
  writer.put("true_normal", std::span(n.data(), 3));
  writer.put("true_axis", std::array{-n.x(), -n.y(), -n.z()});
  writer.put("middle", std::span(middle.data(), 3));
  writer.put("allowed", bar.tolerance * error_size(c, bar));
  writer.put("threshold", bar.threshold);
  writer.texts["truth_low"] = low;
  writer.texts["truth_high"] = high;
  writer.texts["tolerance"] = fmt::format("{}", bar.tolerance);
  return writer.texts;
}

/// Jolt's convex radii, by a rule for the smallest half extent of a shape.
Texts convex_radius_texts(const Configuration& c, const std::function<double(double)>& rule) {
  const auto smallest = [](const ts_shape& shape) {
    const int count = shape.kind == TS_BOX ? 3 : 2;
    return *std::min_element(shape.size, shape.size + count);
  };
  Writer writer(NumberStyle::decimal);
  writer.put("convex_radius_a", rule(smallest(to_ts_shape(c.a))));
  writer.put("convex_radius_b", rule(smallest(to_ts_shape(c.b))));
  return writer.texts;
}

// The programs.

struct Language {
  std::string_view name;    ///< for --language
  std::string_view remark;  ///< begins one
  const std::string_view& shared;
  NumberStyle numbers;
};
const Language cpp = {"c++", "//", cpp_template, NumberStyle::hexadecimal};
const Language javascript = {"javascript", "//", javascript_template, NumberStyle::decimal};
const Language python = {"python", "#", python_template, NumberStyle::decimal};

/// A program that asks an engine.
struct Program {
  std::string_view engine;     ///< name for --emit, without parameter
  std::string_view candidate;  ///< gives the answers that it repeats
  std::string_view title;
  const Language& language;
  const std::string_view& source;
  std::string_view tag;  ///< for its lines
  bool plane = true;     ///< it has a routine for the half-space
};

/// Those that need nothing of ours. The first of an engine is the usual one.
const std::array programs = {
    Program{"bullet", "bullet", "Bullet", cpp, bullet_template, "deepest"},
    Program{"ode", "ode", "ODE", cpp, ode_template, "deepest"},
    Program{"fcl", "fcl", "FCL", cpp, fcl_template, "deepest"},
    Program{"libccd", "libccd-gjk", "libccd", cpp, libccd_template, "deepest", false},
    Program{"mujoco", "mujoco", "MuJoCo", cpp, mujoco_template, "deepest"},
    Program{"jolt", "jolt", "Jolt", javascript, jolt_mjs_template, "query"},
    Program{"jolt", "jolt", "Jolt", cpp, jolt_doctest_template, "doctest"},
    Program{"jolt-margin-0", "jolt-margin-0", "Jolt", javascript, jolt_mjs_template, "query"},
    Program{"jolt-margin-0", "jolt-margin-0", "Jolt", cpp, jolt_doctest_template, "doctest"},
    Program{"jolt-margin", "jolt-margin", "Jolt", javascript, jolt_mjs_template, "query"},
    Program{"jolt-margin", "jolt-margin", "Jolt", cpp, jolt_doctest_template, "doctest"},
    Program{"jolt-world", "jolt-world", "Jolt", javascript, jolt_mjs_template, "world"},
    Program{"rapier", "rapier", "Rapier", javascript, rapier_mjs_template, "query"},
    Program{"rapier-world", "rapier-world", "Rapier", javascript, rapier_mjs_template, "world"},
    Program{"physx", "physx", "PhysX", javascript, physx_mjs_template, "query"},
    Program{"physx-world", "physx-world", "PhysX", javascript, physx_mjs_template, "world"},
    Program{"havok", "havok", "Havok", javascript, havok_mjs_template, "", false},
    Program{"mujoco3", "mujoco3", "MuJoCo", javascript, mujoco3_mjs_template, ""},
    Program{"mujoco3", "mujoco3", "MuJoCo", python, mujoco3_py_template, ""},
    Program{"mujoco3-single", "mujoco3-single", "MuJoCo", javascript, mujoco3_mjs_template,
            "single"},
    Program{"mujoco3-single", "mujoco3-single", "MuJoCo", python, mujoco3_py_template, "single"}};

std::string_view family_of(std::string_view name) { return name.substr(0, name.find(':')); }

/// A string of C, JavaScript and Python.
std::string string_literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '\n') {
      result += "\\n";
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + '"';
}

/// Throws InvalidInput (field "--emit") with those that exist.
[[noreturn]] void refuse(std::string_view name, bool with_plane) {
  std::vector<std::string> names = reproducer_engines();
  if (with_plane) {
    std::erase_if(names, [](const std::string& n) {
      return std::none_of(programs.begin(), programs.end(),
                          [&](const Program& p) { return p.engine == n && p.plane; });
    });
  }
  throw InvalidInput(
      "--emit", string_literal(name),
      fmt::format("must be one of {}, or another candidate{}", fmt::join(names, ", "),
                  with_plane ? ", that knows a half-space" : ""));
}

/// The candidate of that name; null if it cannot be asked here, which few programs need.
const Candidate* askable_candidate(std::string_view name) {
  const NpmEngine* const engine = find_npm_engine(family_of(name));
  if (engine && !npm_obstacle(*engine).empty()) return nullptr;
  try {
    return &find_candidate(name);
  } catch (const InvalidInput& e) {
    if (name == family_of(name)) return nullptr;
    throw InvalidInput("--emit", e.value(), e.remedy());  // about its parameter
  }
}

/// The program for an engine or candidate in a language, or the usual one.
const Program& find_program(std::string_view name, std::string_view language,
                            const Configuration& c, const Candidate* candidate) {
  static const Program plugin{"", "", "", cpp, plugin_template, "points"};
  static const Program command{"", "", "", python, command_py_template, "points"};
  const Pair pair = pair_of(c);
  std::vector<const Program*> of_engine;
  for (const Program& p : programs) {
    // Another setting of an engine is asked as the plug-in that it is.
    if (p.engine == (find_npm_engine(family_of(name)) ? family_of(name) : name) ||
        p.candidate == name) {
      of_engine.push_back(&p);
    }
  }
  if (of_engine.empty()) {
    if (!candidate || (candidate->command.empty() && candidate->plugin.empty())) {
      refuse(name, pair == Pair::plane);
    }
    of_engine.push_back(candidate->command.empty() ? &plugin : &command);
  }
  if (pair == Pair::plane && !of_engine[0]->plane) refuse(name, true);
  if (candidate && !candidate->has_routine_for(pair)) {
    throw InvalidInput("--emit", string_literal(name),
                       fmt::format("must be a candidate with a routine for {}", pair_name(pair)));
  }
  std::string names;
  for (const Program* p : of_engine) {
    if (language.empty() || p->language.name == language) return *p;
    names += (names.empty() ? "" : " or ") + std::string(p->language.name);
  }
  throw InvalidInput("--language", string_literal(language),
                     fmt::format("must be {} for {}", names, name));
}

/// The candidate's answer here and now, for a comment.
std::string seen(std::string_view title, NumberStyle numbers, const Candidate* candidate,
                 const Configuration& c, const oracle::Truth& truth, const Bar& bar,
                 const Limits& limits) {
  if (!candidate) return fmt::format("{} is not installed where this was written", title);
  const Answer answer = CandidateProcess(*candidate, bar.threshold, limits).answer(c);
  const Outcome outcome = score(c, truth, answer, bar).outcome;
  std::string text = fmt::format("{} {}: {}", title, candidate->version, outcome_name(outcome));
  if (answer.status == TS_CONTACT) {
    text += ", signed distance ";
    text += numbers == NumberStyle::decimal ? fmt::format("{}", answer.signed_distance)
                                            : fmt::format("{:.17g}", answer.signed_distance);
  }
  return text;
}

/// How far the true distance lies from what may be answered.
std::string_view tag_of_distance(double distance, double allowed, double threshold) {
  if (distance > threshold + allowed) return "apart";
  return distance < -allowed ? "overlapping" : "touching";
}

/// The version of one of npm's packages that candidates/npm is made for.
std::string package_version(std::string_view package) {
  const std::string member = fmt::format("\"{}\": \"", package);
  const std::string_view rest = package_json.substr(package_json.find(member) + member.size());
  return std::string(rest.substr(0, rest.find('"')));
}

/// The folder of touchstone/candidate.h, of a build or an installed program.
std::string include_folder() {
  const auto program = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  for (const char* folder : {"include", "../include", "../../include"}) {
    const auto path = (program / folder).lexically_normal();
    if (std::filesystem::exists(path / "touchstone/candidate.h")) return path.string();
  }
  return "PREFIX/include";
}

/// What stands in the programs of npm's engines alone.
Texts npm_texts(const Program& program, std::string_view name, const Candidate* candidate,
                const Configuration& c) {
  const NpmEngine* const engine = find_npm_engine(program.candidate);
  if (!engine) return {};
  const std::string version = package_version(engine->package);
  Texts texts{{"npm", std::string(engine->package)},
              {"version", version},
              {"package", fmt::format("{}@{}", engine->package, version)},
              {"multiccd", program.tag == "single" ? "off" : "on, as by default"}};
  std::function<double(double)> rule = [](double smallest) { return std::min(0.05, smallest / 2); };
  texts["convex_rule"] = "0.05 m, at most half of the smallest half extent";
  if (program.engine == "jolt-margin-0") {
    texts["convex_rule"] = "0";
    rule = [](double) { return 0.0; };
  } else if (program.engine == "jolt-margin") {
    const auto given = parse_double(name.substr(name.find(':') + 1));
    if (!candidate && !given) {
      throw InvalidInput("--emit", string_literal(name),
                         "must be jolt-margin: and the radius, metres");
    }
    const double radius = candidate ? candidate->value : *given;
    texts["convex_rule"] = fmt::format("{} m, at most the smallest half extent", radius);
    rule = [radius](double smallest) { return std::min(radius, smallest); };
  }
  texts.merge(convex_radius_texts(c, rule));
  return texts;
}

/// What stands in the programs that ask a plug-in or a command.
Texts candidate_texts(const Candidate* candidate) {
  if (!candidate) return {};
  return {{"name", candidate->name},
          {"index", std::to_string(candidate->index)},
          {"parameter", fmt::format("{}", candidate->value)},
          {"plugin", string_literal(candidate->plugin.string())},
          {"include", include_folder()},
          {"command", string_literal(candidate->command)},
          {"folder", string_literal(candidate->folder.string())}};
}

// Templates are programs with two additions: @name@ stands for a text, and a line that begins with
// [tag] or [tag,tag] is there only where one of the tags applies; with several brackets, one of
// each. A file may have sections, each after a line "=== name".

using Tags = std::vector<std::string_view>;

/// Does one of the names in a list with commas stand among the tags?
bool names_one(std::string_view list, const Tags& tags) {
  while (!list.empty()) {
    const auto comma = list.find(',');
    if (std::find(tags.begin(), tags.end(), list.substr(0, comma)) != tags.end()) return true;
    list = comma == list.npos ? "" : list.substr(comma + 1);
  }
  return false;
}

/// The lines for these tags, without the brackets.
std::string lines_for(const Tags& tags, std::string_view source) {
  std::string result;
  while (!source.empty()) {
    const auto end = std::min(source.find('\n'), source.size() - 1) + 1;
    std::string_view line = source.substr(0, end);
    source.remove_prefix(end);
    bool applies = true;
    while (applies && line.starts_with('[')) {
      const auto close = line.find(']');
      applies = names_one(line.substr(1, close - 1), tags);
      line.remove_prefix(close + (line[close + 1] == ' ' ? 2 : 1));
    }
    if (applies) result += line;
  }
  return result;
}

/// The lines of a section, without the last line's end.
std::string_view section(std::string_view source, std::string_view name) {
  const std::string heading = "=== " + std::string(name) + '\n';
  source.remove_prefix(source.find(heading) + heading.size());
  return source.substr(0, source.find("\n=== "));
}

/// The template's lines for these tags with every @name@ replaced, without empty lines at the end;
/// what is put in is not searched again. Throws std::out_of_range for an unknown name.
std::string fill_template(std::string_view source, const Tags& tags, const Texts& texts) {
  const std::string lines = lines_for(tags, source);
  std::string result;
  for (std::string_view rest = lines;;) {
    const auto at = rest.find('@');
    result += rest.substr(0, at);
    if (at == rest.npos) break;
    const auto end = rest.find('@', at + 1);
    result += texts.at(std::string(rest.substr(at + 1, end - at - 1)));
    rest.remove_prefix(end + 1);
  }
  return result.substr(0, result.find_last_not_of('\n') + 1);
}

}  // namespace

std::vector<std::string> reproducer_engines() {
  std::vector<std::string> names;
  for (const Program& p : programs) {
    if (names.empty() || names.back() != p.engine) names.emplace_back(p.engine);
  }
  return names;
}

std::string reproducer(std::string_view name, std::string_view language, const Configuration& c,
                       const std::string& asked, const Bar& bar, const Limits& limits) {
  const auto same = [&](const Program& p) { return p.engine == name; };
  const auto of_engine = std::find_if(programs.begin(), programs.end(), same);
  const Candidate* const candidate =
      askable_candidate(of_engine == programs.end() ? name : of_engine->candidate);
  const Program& program = find_program(name, language, c, candidate);
  const std::string title(program.title.empty() ? "The candidate" : program.title);

  const oracle::Truth truth = oracle::truth(c);
  const double allowed = bar.tolerance * error_size(c, bar);
  const NumberStyle numbers = program.language.numbers;
  Texts texts = question_texts(c, numbers);
  texts.merge(truth_texts(c, truth, bar, numbers));
  texts.merge(npm_texts(program, name, candidate, c));
  texts.merge(candidate_texts(candidate));
  const std::string shape = shape_name(c.b);
  // PhysX's query knows no plane, which its candidate asks a scene about.
  const bool in_scene = program.engine == "physx" && pair_of(c) == Pair::plane;
  const Tags tags{shape, in_scene ? "world" : program.tag,
                  tag_of_distance(truth.signed_distance.midpoint(), allowed, bar.threshold),
                  candidate && candidate->in_frames ? "frames" : "lines",
                  program.tag == "doctest" ? "" : "program"};
  texts.merge(Texts{{"engine", title},
                    {"asked", asked},
                    {"remark", std::string(program.language.remark)},
                    {"seen", seen(title, numbers, candidate, c, truth, bar, limits)}});
  const auto part = [&](std::string_view source) { return fill_template(source, tags, texts); };
  texts["mjcf"] = part(mjcf_template);
  texts["head"] = part(head_template);
  texts["question"] = part(section(program.language.shared, "question")) + '\n';
  texts["judgement"] = part(section(program.language.shared, "judgement"));
  return part(program.source) + '\n';
}

}  // namespace touchstone
