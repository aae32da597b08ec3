#include "reports/idioms/idiom.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <memory>

#include "candidates/candidates.hpp"
#include "candidates/npm_engines.hpp"
#include "properties/named.hpp"
#include "properties/pose_class.hpp"
#include "reference/invalid_input.hpp"
#include "reference/support.hpp"
#include "reports/idioms/axes.hpp"
#include "reports/idioms/case_texts.hpp"
#include "reports/idioms/cases.hpp"
#include "reports/replay.hpp"
#include "reports/reproducer/fill_template.hpp"
#include "reports/reproducer/programs.hpp"

namespace touchstone {

// Made by the build from the files tests.*.in of candidates/reproducers.
extern const std::string_view tests_cpp_template, tests_mjs_template, tests_py_template,
    callable_py_template, mjcf_template;

namespace {

/// A framework of tests, in which files are written for the programs of a language.
struct Idiom {
  std::string_view name;
  const Language& language;
  const std::string_view& frame;
  std::string_view marker;  ///< that a program's template has if it can be written so
  Texts texts;              ///< of every file
};

// Of these no program is taken: a model of MuJoCo asks nothing, and parry's crate is not npm's
// package.
constexpr std::string_view no_program = "@head@\n@question@@judgement@";

bool has_program(const Language& language) {
  return &language != &model_language && &language != &rust;
}

const std::vector<Idiom>& all_idioms() {
  static const std::vector<Idiom> all = {
      {"gtest",
       cpp,
       tests_cpp_template,
       "@override@",
       {{"program", "cylinder_contacts_test"},
        {"and_libraries", " -lgtest_main -lgtest"},
        {"and_packages", " libgtest-dev"},
        {"override", " override"}}},
      {"boost",
       cpp,
       tests_cpp_template,
       "@override@",
       {{"program", "cylinder_contacts_test"},
        {"and_libraries", ""},
        {"and_packages", " libboost-dev"},
        {"override", " override"}}},
      {"unittest", python, tests_py_template, "", {{"program", "cylinder_contacts_test"}}},
      {"doctest", cpp, tests_cpp_template, "@case@", {}},
      {"js", javascript, tests_mjs_template, "@question@", {{"program", "cylinder_contacts.test"}}},
      {"rust", rust, rust.shared, "", {}},
      {"mjcf", model_language, model_language.shared, "", {}}};
  return all;
}

/// Can its part that asks stand in a class, or a function, of its own for each pair? Jolt's world
/// keeps the bodies of earlier cases, and its margins are of no usual world.
bool fits(const Program& program, const Idiom& idiom) {
  if (&idiom.language == &model_language) return program.title == "MuJoCo";
  if (&idiom.language == &rust) return program.engine == "rapier";
  return &program.language == &idiom.language && program.engine != "jolt-margin" &&
         program.engine != "jolt-world" && !has_floor(program) &&
         program.source.find(idiom.marker) != program.source.npos;
}

Program program_of(const Idiom& idiom, const std::string& engine) {
  // A release of npm's is asked by the engine's program.
  const std::string_view name = npm_release(engine).empty() ? engine : family_of(engine);
  if (name == "rapier-world" && name != engine) {
    throw InvalidInput("--engine", in_quotes(engine),
                       "must be rapier-world or rapier@ and a release: what older worlds answer "
                       "depends on what they were asked before");
  }
  // Any function of Python, of which the file imports what has the engine's name.
  if (&idiom.language == &python) return {name, engine, name, python, callable_py_template, ""};
  std::vector<std::string_view> names;
  for (const Program& p : programs()) {
    if (!fits(p, idiom)) continue;
    if (p.engine == name) {
      Program found = p;
      if (name != engine) found.candidate = engine;
      if (has_program(idiom.language)) return found;
      return {p.engine, found.candidate, p.title, idiom.language, no_program, p.tags};
    }
    if (names.empty() || names.back() != p.engine) names.push_back(p.engine);
  }
  throw InvalidInput(
      "--engine", in_quotes(engine),
      fmt::format("must be one of {} for --as {}", fmt::join(names, ", "), idiom.name));
}

/// What asks the engine; nothing where it is not installed. A release that is named has to be, as
/// the file is about what that release gets wrong.
const Candidate* installed(const Program& program) {
  try {
    return &find_candidate(program.candidate);
  } catch (const InvalidInput& e) {
    if (npm_release(program.candidate).empty()) return nullptr;
    throw InvalidInput("--engine", e.value(), e.remedy());
  }
}

/// Each line that is not empty, moved to the right.
std::string indented(std::string_view text, std::string_view by) {
  std::string result;
  for (const std::string_view line : split(text, '\n')) {
    if (!result.empty()) result += '\n';
    if (!line.empty()) result += std::string(by) + std::string(line);
  }
  return result;
}

Habit habit_of(const Program& program, const Tags& tags) {
  const auto has = [&](std::string_view tag) {
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
  };
  return {has("x") ? 'x' : has("y") ? 'y' : 'z', program.title == "MuJoCo"};
}

/// Half of the side of a square about the origin, seen along z, that the bodies stand in, metres: a
/// power of two, so that few places of such squares are rounded. Half-spaces stand in all.
double half_square(const std::vector<IdiomCase>& cases) {
  double reach = 0;
  for (const IdiomCase& c : cases) {
    for (const Vec3& way :
         std::array<Vec3, 4>{Vec3::UnitX(), -Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitY()}) {
      const Configuration& bodies = c.configuration;
      reach = std::max(reach, support(bodies.a, bodies.pose_a, way));
      if (pair_of(bodies) == Pair::plane) continue;
      reach = std::max(reach, support(bodies.b, bodies.pose_b, way));
    }
  }
  return std::exp2(std::ceil(std::log2(reach)));
}

/// What writes the same file again.
std::string command_of(const IdiomRequest& request) {
  std::string command = fmt::format("touchstone export --as {} --engine {} --limit {} --seed {}",
                                    request.idiom, request.engine, request.limit, request.seed);
  if (request.pairs.size() == std::size(all_pairs)) return command;
  std::vector<const char*> names;
  for (const Pair pair : request.pairs) names.push_back(pair_name(pair));
  return command + fmt::format(" --pair {}", fmt::join(names, ","));
}

}  // namespace

std::vector<std::string> idioms() {
  std::vector<std::string> names;
  for (const Idiom& idiom : all_idioms()) names.emplace_back(idiom.name);
  return names;
}

std::string idiom_file(const IdiomRequest& request) {
  const Idiom& idiom = named(all_idioms(), request.idiom, "--as");
  const bool is_python = &idiom.language == &python;
  const Program program = program_of(idiom, request.engine);
  const Candidate* const candidate = installed(program);
  std::unique_ptr<CandidateProcess> process;
  IdiomQuestion question{{}, request.seed, request.limit, request.bar, false, false, {}};
  for (const Pair pair : request.pairs) {
    if (knows(program, pair)) question.pairs.push_back(pair);
  }
  if (question.pairs.empty()) {
    throw InvalidInput("--pair", in_quotes(pair_name(request.pairs.front())),
                       fmt::format("must be one that {} knows", program.engine));
  }
  const std::string_view release = tag_of_release(program.candidate);
  Tags tags = names_in(program.tags);
  tags.push_back(release);
  const auto has = [&](std::string_view tag) {
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
  };
  question.is_single = has("float") || (candidate && candidate->precision == "float");
  question.is_moved = &idiom.language == &model_language;
  const Habit habit = habit_of(program, tags);
  if (candidate) {
    process = std::make_unique<CandidateProcess>(*candidate, request.bar.threshold, request.limits);
    question.ask = [&](const Configuration& c) { return answer_in_axis(*process, c, habit.axis); };
  }
  const std::vector<IdiomCase> cases = idiom_cases(question);
  if (cases.empty()) {
    throw InvalidInput("--pair", in_quotes(pair_name(question.pairs.front())),
                       "must be one with arrangements of poses");
  }

  std::string version = candidate ? candidate->version : "(not installed)";
  if (candidate && find_npm_engine(program.candidate)) version += " of npm";
  Texts texts = idiom.texts;
  texts.merge(Texts{{"engine", std::string(program.title)},
                    {"engine_version", version},
                    {"command", command_of(request)},
                    {"module", with_underscores(std::string(program.engine))},
                    {"single_precision", is_python ? question.is_single ? "True" : "False"
                                         : question.is_single ? "true"
                                                              : "false"},
                    {"axis_name", std::string(1, habit.axis)},
                    {"axis", habit.axis == 'x'   ? "1, 0, 0"
                             : habit.axis == 'y' ? "0, 1, 0"
                                                 : "0, 0, 1"},
                    {"order", habit.real_part_first ? "w, x, y, z" : "x, y, z, w"}});
  if (&idiom.language == &rust) texts["axis"] = with_points(texts["axis"]);
  texts.merge(npm_texts(program, program.candidate, candidate, cases.front().configuration));
  const Tags of_file = {"engine", "contact",  "solid",
                        release,  idiom.name, habit.real_part_first ? "wxyz" : "xyzw"};
  const auto tags_of = [&](const IdiomCase& c) {
    const Pair pair = pair_of(c.configuration);
    Tags result = names_in(tags_for(program, pair));
    result.insert(result.end(), of_file.begin(), of_file.end());
    const std::string_view name = pair_name(pair);
    result.push_back(name.substr(name.find('-') + 1));
    return result;
  };
  // MuJoCo 2 leaves contacts out for which it has no room: Touchstone's own have at most eight
  // points.
  texts["room"] = std::to_string(8 * cases.size());
  Tags of_all = tags;
  for (const IdiomCase& c : cases) {
    for (const std::string_view tag : tags_of(c)) of_all.push_back(tag);
  }
  const auto frame = [&](std::string_view name, const Tags& its_tags) {
    return fill_template(section(idiom.frame, name), its_tags, texts);
  };
  texts["answer"] = fill_template(section(idiom.language.shared, "answer"), of_all, texts);
  texts["head"] = frame("head", of_all);
  const bool is_doctest = idiom.name == "doctest";
  const bool is_model = &idiom.language == &model_language;
  const std::string_view asked = is_doctest ? "@case@" : "@question@";
  const std::string_view judged = is_doctest ? "@end@" : "@judgement@";
  const std::string_view source = program.source;
  const auto question_at = source.find(asked);
  const std::string_view once = source.substr(0, question_at);
  const std::string_view asking =
      source.substr(question_at + asked.size(), source.find(judged) - question_at - asked.size());
  std::string file = fill_template(once, of_all, texts) + '\n';
  if (!is_doctest && !is_model) file += '\n' + frame("judge", of_all) + '\n';
  const double side = is_model ? 2 * half_square(cases) : 0;
  constexpr int in_row = 8;  // of the squares of a model's cases
  int square = 0;
  std::string shape;
  for (const IdiomCase& c : cases) {
    for (auto& [name, text] :
         case_texts(c, fmt::format("{} {}", program.title, version), idiom.language, habit)) {
      texts[name] = text;
    }
    for (auto& [name, text] : npm_texts(program, program.candidate, candidate, c.configuration)) {
      texts[name] = text;
    }
    Tags of_case = tags_of(c);
    if (is_doctest) {
      for (auto& [name, text] : jolt_texts(c, request.bar)) texts[name] = text;
      texts["turn_a_float"] = texts["xyzw_a_float"];
      texts["turn_b_float"] = texts["xyzw_b_float"];
      of_case.push_back(tag_of_distance(c));
      file +=
          fmt::format("{}{}\n{}\n", &c == &cases.front() ? "" : "\n",
                      indented(texts["sentences"], "\t"), fill_template(asking, of_case, texts));
      continue;
    }
    const int column = square % in_row, row = square / in_row;
    texts["place"] = fmt::format("{} {} 0", column * side, row * side);
    ++square;
    if (has_program(idiom.language) && texts["shape_b"] != shape) {
      shape = texts["shape_b"];
      Texts symbolic = texts;
      if (&idiom.language == &javascript) {
        symbolic = names_in_javascript();
        symbolic.merge(Texts(texts));
        symbolic["mjcf"] = fill_template(mjcf_template, of_case, symbolic);
      }
      const std::string lines = fill_template(asking, of_case, symbolic);
      texts["asking"] =
          indented(lines.substr(lines.find_first_not_of('\n')), is_python ? "    " : "  ");
      file += '\n' + frame("pair", of_case) + '\n';
    }
    file += '\n' + frame("case", of_case) + '\n';
  }
  if (is_doctest) return file + std::string(source.substr(source.find(judged) + judged.size()));
  const std::string foot = frame("foot", of_all);
  return file + (foot.empty() ? "" : '\n' + foot + '\n');
}

}  // namespace touchstone
