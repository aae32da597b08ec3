#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <string>

#include "candidates/candidates.hpp"
#include "candidates/npm_engines.hpp"
#include "candidates/readable.hpp"
#include "oracle/truth.hpp"
#include "properties/files/given_text.hpp"
#include "properties/numbers.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"
#include "reports/reproducer/texts.hpp"

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
  std::string_view tags;  ///< for its lines, with commas
  bool plane = true;      ///< it has a routine for the half-space
};

/// Those that need nothing of ours. The first of an engine is the usual one.
const std::array programs = {
    Program{"bullet", "bullet", "Bullet", cpp, bullet_template, "double,rounded"},
    Program{"bullet-margin-0", "bullet-margin-0", "Bullet", cpp, bullet_template, "double,sharp"},
    Program{"bullet-float", "bullet-float", "Bullet", cpp, bullet_template, "float,rounded"},
    Program{"bullet-float-margin-0", "bullet-float-margin-0", "Bullet", cpp, bullet_template,
            "float,sharp"},
    Program{"ode", "ode", "ODE", cpp, ode_template, ""},
    Program{"fcl", "fcl", "FCL", cpp, fcl_template, "collide"},
    Program{"fcl-indep", "fcl-indep", "FCL", cpp, fcl_template, "indep"},
    Program{"fcl-distance", "fcl-distance", "FCL", cpp, fcl_template, "distance", false},
    Program{"libccd", "libccd-gjk", "libccd", cpp, libccd_template, "gjk", false},
    Program{"libccd-mpr", "libccd-mpr", "libccd", cpp, libccd_template, "mpr", false},
    Program{"mujoco", "mujoco", "MuJoCo", cpp, mujoco_template, ""},
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

/// A string of C and Python.
std::string string_literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f) {
      result += fmt::format("\\{:03o}", code);  // some controls end a line of source
    } else {
      if (c == '"' || c == '\\') result += '\\';
      result += c;
    }
  }
  return result + '"';
}

/// Has the program lines for the pair? Those that know convex bodies have lines for them.
bool knows(const Program& program, Pair pair) {
  if (pair == Pair::plane) return program.plane;
  return pair != Pair::convex || program.source.find("convex]") != program.source.npos;
}

/// Throws InvalidInput (field "--emit") with those that know the pair.
[[noreturn]] void refuse(std::string_view name, Pair pair) {
  std::vector<std::string> names = reproducer_engines();
  std::erase_if(names, [&](const std::string& n) {
    return std::none_of(programs.begin(), programs.end(),
                        [&](const Program& p) { return p.engine == n && knows(p, pair); });
  });
  const char* const what = pair == Pair::plane    ? ", that knows a half-space"
                           : pair == Pair::convex ? " of a plug-in, that knows convex bodies"
                                                  : "";
  throw InvalidInput(
      "--emit", string_literal(name),
      fmt::format("must be one of {}, or another candidate{}", fmt::join(names, ", "), what));
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
  static const Program plugin{"", "", "", cpp, plugin_template, ""};
  static const Program command{"", "", "", python, command_py_template, ""};
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
    if (!candidate || (!candidate->command() && !candidate->plugin())) refuse(name, pair);
    of_engine.push_back(candidate->command() ? &command : &plugin);
  }
  std::erase_if(of_engine, [&](const Program* p) { return !knows(*p, pair); });
  if (of_engine.empty()) refuse(name, pair);
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
  if (distance < -allowed) return "overlapping";
  return distance > allowed ? "near" : "touching";
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
              {"multiccd", program.tags == "single" ? "off" : "on, as by default"}};
  std::function<double(double)> rule = [](double smallest) { return std::min(0.05, smallest / 2); };
  texts["convex_rule"] = "0.05 m, at most half of the smallest half extent";
  if (program.engine == "jolt-margin-0") {
    texts["convex_rule"] = "0";
    rule = [](double) { return 0.0; };
  } else if (program.engine == "jolt-margin") {
    const auto given = parse_double(name.substr(name.find(':') + 1));
    // As candidates/npm/jolt.mjs has it.
    if (!candidate && !(given && *given >= 0 && *given <= 1)) {
      throw InvalidInput("--emit", string_literal(name),
                         "must be jolt-margin: and the radius, from 0 to 1 metre");
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
  Texts texts = {{"name", candidate->name},
                 {"parameter", fmt::format("{}", candidate->value)},
                 {"include", shell_quoted(include_folder())}};
  if (const auto* const plugin = candidate->plugin()) {
    texts.merge(Texts{{"index", std::to_string(plugin->index)},
                      {"plugin", string_literal(plugin->file.string())}});
  }
  if (const auto* const command = candidate->command()) {
    texts.merge(Texts{{"command", string_literal(command->line)},
                      {"folder", string_literal(command->folder.string())}});
  }
  return texts;
}

// Templates are programs with two additions: @name@ stands for a text, and a line that begins with
// [tag] or [tag,tag] is there only where one of the tags applies; with several brackets, one of
// each. A file may have sections, each after a line "=== name".

using Tags = std::vector<std::string_view>;

/// The names in a list with commas.
Tags names_in(std::string_view list) {
  Tags names;
  while (!list.empty()) {
    const auto comma = list.find(',');
    names.push_back(list.substr(0, comma));
    list = comma == list.npos ? "" : list.substr(comma + 1);
  }
  return names;
}

/// Does one of the names in a list with commas stand among the tags?
bool names_one(std::string_view list, const Tags& tags) {
  const Tags names = names_in(list);
  return std::find_first_of(names.begin(), names.end(), tags.begin(), tags.end()) != names.end();
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

/// A test case of Jolt has floats, which must hold the numbers of both bodies.
void require_floats(std::string_view name, const Configuration& c) {
  Numbers numbers = numbers_of(c);
  const auto is_beyond = [](double x) { return !std::isfinite(static_cast<float>(x)); };
  const auto is_lost = [](double x) { return static_cast<float>(x) == 0; };
  const auto refuse_number = [&](double x) {
    throw InvalidInput("--emit", string_literal(name),
                       fmt::format("must be asked in a language of doubles, as javascript: no "
                                   "float holds {:g}",
                                   x));
  };
  for (const double size : numbers.sizes) {
    if (is_lost(size)) refuse_number(size);
  }
  for (const double* number : every_number(numbers)) {
    if (is_beyond(*number)) refuse_number(*number);
  }
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
  if (program.tags == "doctest") require_floats(name, c);
  const std::string title(program.title.empty() ? "The candidate" : program.title);

  // Its numbers are those that the engine gets, which are rounded, and so is the truth of them.
  const Configuration given = as_asked(c);
  const oracle::Truth truth = oracle::truth(given);
  const double allowed = bar.tolerance * error_size(given, bar);
  const NumberStyle numbers = program.language.numbers;
  Texts texts = question_texts(c, numbers);
  texts.merge(truth_texts(given, truth, bar, numbers));
  texts.merge(npm_texts(program, name, candidate, c));
  texts.merge(candidate_texts(candidate));
  const std::string shape = shape_name(c.b);
  // PhysX's query knows no plane, which its candidate asks a scene about.
  const bool in_scene = program.engine == "physx" && pair_of(c) == Pair::plane;
  Tags tags = names_in(in_scene ? "world" : program.tags);
  tags.insert(
      tags.end(),
      {shape, tag_of_distance(truth.signed_distance.midpoint(), allowed, bar.threshold),
       candidate && candidate->command() && candidate->command()->in_frames ? "frames" : "lines",
       program.engine.empty() ? "plugin" : "engine",
       program.tags == "doctest" ? "test" : "program"});
  texts.merge(
      Texts{{"engine", title},
            // A backslash at a line's end would make the next one a part of the comment.
            {"asked", escaped(asked, Printed::one_line) + (asked.ends_with('\\') ? "." : "")},
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
