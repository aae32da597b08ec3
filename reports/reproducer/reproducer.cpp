#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>

#include "candidates/candidates.hpp"
#include "candidates/floor.hpp"
#include "candidates/host/ask_cast.hpp"
#include "candidates/npm_engines.hpp"
#include "candidates/readable.hpp"
#include "oracle/first_touch.hpp"
#include "oracle/judge/cast_score.hpp"
#include "oracle/truth.hpp"
#include "properties/files/given_text.hpp"
#include "properties/numbers.hpp"
#include "reference/invalid_input.hpp"
#include "reports/replay.hpp"
#include "reports/reproducer/fill_template.hpp"
#include "reports/reproducer/programs.hpp"
#include "reports/reproducer/texts.hpp"

namespace touchstone {

// Made by the build, as those of programs.cpp.
extern const std::string_view head_template, mjcf_template, plugin_template, command_py_template;

namespace {

/// What a program is asked about, whose first touch is known of a cast.
struct Question {
  const Configuration& configuration;
  const std::optional<Vec3>& sweep;

  bool is_known_to(const Program& p) const {
    const Pair pair = pair_of(configuration);
    return sweep ? knows_casts(p, pair) : knows(p, pair);
  }
};

/// Throws InvalidInput (field "--emit") with those that know the pair, and casts if one is asked.
[[noreturn]] void refuse(std::string_view name, const Question& question) {
  std::vector<std::string> names = reproducer_engines();
  std::erase_if(names, [&](const std::string& n) {
    return std::none_of(programs().begin(), programs().end(),
                        [&](const Program& p) { return p.engine == n && question.is_known_to(p); });
  });
  const Pair pair = pair_of(question.configuration);
  if (question.sweep) {
    throw InvalidInput("--emit", string_literal(name),
                       fmt::format("must be one of {}, whose programs know casts of {}",
                                   fmt::join(names, ", "), pair_name(pair)));
  }
  const char* const what = pair == Pair::plane    ? ", that knows a half-space"
                           : pair == Pair::convex ? " of a plug-in, that knows convex bodies"
                                                  : "";
  throw InvalidInput(
      "--emit", string_literal(name),
      fmt::format("must be one of {}, or another candidate{}", fmt::join(names, ", "), what));
}

/// The candidate of that name; null if it cannot be asked here, which few programs need.
const Candidate* askable_candidate(std::string_view name) {
  const NpmEngine* const engine = find_npm_engine(name);
  if (engine && !npm_obstacle(*engine, npm_release(name)).empty()) return nullptr;
  try {
    return &find_candidate(name);
  } catch (const InvalidInput& e) {
    if (name == family_of(name)) return nullptr;
    throw InvalidInput("--emit", e.value(), e.remedy());  // about its parameter
  }
}

/// The program for an engine or candidate in a language, or the usual one.
const Program& find_program(std::string_view name, std::string_view language,
                            const Question& question, const Candidate* candidate) {
  static const Program plugin{"", "", "", cpp, plugin_template, ""};
  static const Program command{"", "", "", python, command_py_template, ""};
  const Configuration& c = question.configuration;
  if (c.a.rounding() > 0 || rounding_of(c.b) > 0) {
    throw InvalidInput("--emit", string_literal(name),
                       "must be left out: programs have no rounded bodies");
  }
  const Pair pair = pair_of(c);
  std::vector<const Program*> of_engine;
  for (const Program& p : programs()) {
    // Another setting of an engine is asked as the plug-in that it is.
    const bool takes_number = find_npm_engine(name) || has_floor(p);
    if (p.engine == (takes_number ? family_of(name) : name) || p.candidate == name) {
      of_engine.push_back(&p);
    }
  }
  if (of_engine.empty()) {
    if (!candidate || question.sweep || (!candidate->command() && !candidate->plugin())) {
      refuse(name, question);
    }
    of_engine.push_back(candidate->command() ? &command : &plugin);
  }
  std::erase_if(of_engine, [&](const Program* p) { return !question.is_known_to(*p); });
  if (of_engine.empty()) refuse(name, question);
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

/// Likewise its answer to a cast.
std::string seen_cast(std::string_view title, const Candidate* candidate, const Configuration& c,
                      const Vec3& sweep, const oracle::FirstTouch& touch, const Bar& bar) {
  if (!candidate) return fmt::format("{} is not installed where this was written", title);
  const CastQuestion question{c, sweep};
  const std::optional<CastAnswer> answer = ask_casts(*candidate, {&question, 1}).front();
  if (!answer) throw InvalidInput("sweep", "of this pair", "must be one that the engine casts");
  std::string text = fmt::format("{} {}: ", title, candidate->version);
  if (!answer->cast) return text + "failed";
  text += outcome_name(score_cast(c, Sweep(sweep), touch, *answer->cast, bar).outcome);
  if (answer->cast->status == CastStatus::never) return text + ", no touch";
  return text + fmt::format(", touch at {} of the sweep", answer->cast->fraction);
}

/// How far the true distance lies from what may be answered.
std::string_view tag_of_distance(double distance, double allowed, double threshold) {
  if (distance > threshold + allowed) return "apart";
  if (distance < -allowed) return "overlapping";
  return distance > allowed ? "near" : "touching";
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

/// What stands in the programs with a floor of triangles, as candidates/floor.hpp has them.
Texts floor_texts(const Program& program, const Candidate* candidate, const Configuration& c) {
  if (!has_floor(program) || !candidate) return {};
  const int count = static_cast<int>(candidate->value);
  const Floor floor(to_ts_shape(c.a), to_ts_shape(c.b), count);
  const ts_pose at = floor.at(to_ts_pose(c.pose_a), to_ts_pose(c.pose_b));
  return {{"squares", std::to_string(count)},
          {"half_f", fmt::format("{:a}", floor.side() * count / 2)},
          {"position_f", fmt::format("{:a}", fmt::join(at.position, ", "))},
          {"orientation_f", fmt::format("{:a}", fmt::join(at.orientation, ", "))}};
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
  for (const Program& p : programs()) {
    if (names.empty() || names.back() != p.engine) names.emplace_back(p.engine);
  }
  return names;
}

std::string reproducer(std::string_view name, std::string_view language, const Configuration& c,
                       const std::optional<Vec3>& sweep, const std::string& asked, const Bar& bar,
                       const Limits& limits) {
  const auto same = [&](const Program& p) { return p.engine == name; };
  const auto of_engine = std::find_if(programs().begin(), programs().end(), same);
  const Candidate* const candidate =
      askable_candidate(of_engine == programs().end() ? name : of_engine->candidate);
  const Program& program = find_program(name, language, {c, sweep}, candidate);
  const bool is_test = program.tags.starts_with("doctest");
  if (is_test) require_floats(name, c);
  const std::string title(program.title.empty() ? "The candidate" : program.title);

  // Its numbers are those that the engine gets, which are rounded, and so is the truth of them.
  const Configuration given = as_asked(c);
  const NumberStyle numbers = program.language.numbers;
  Tags tags = tags_for(program, pair_of(c), sweep.has_value());
  Texts texts = question_texts(c, numbers);
  if (sweep) {
    const oracle::FirstTouch touch = oracle::first_touch(given, Sweep(*sweep));
    if (touch.status == oracle::FirstTouch::Status::undecided) {
      throw InvalidInput("sweep", "of a graze of which no proof tells whether it touches",
                         "must be another one with --emit");
    }
    texts.merge(cast_texts(given, *sweep, touch, bar, numbers));
    texts["seen"] = seen_cast(title, candidate, given, *sweep, touch, bar);
    tags.emplace_back(status_name(touch.status));
  } else {
    const oracle::Truth truth = oracle::truth(given);
    const double allowed = bar.tolerance * error_size(given, bar);
    texts.merge(truth_texts(given, truth, bar, numbers));
    texts["seen"] = seen(title, numbers, candidate, c, truth, bar, limits);
    tags.push_back(tag_of_distance(truth.signed_distance.midpoint(), allowed, bar.threshold));
  }
  texts.merge(npm_texts(program, name, candidate, c));
  texts.merge(floor_texts(program, candidate, c));
  texts.merge(candidate_texts(candidate));
  const std::string shape = shape_name(c.b);
  tags.insert(
      tags.end(),
      {shape,
       candidate && candidate->command() && candidate->command()->in_frames ? "frames" : "lines",
       program.engine.empty() ? "plugin" : "engine", has_floor(program) ? "floor" : "solid",
       is_test ? "test" : "program", tag_of_release(name)});
  const bool is_round = shape == "cylinder" || shape == "capsule";
  texts.merge(
      Texts{{"engine", title},
            // A backslash at a line's end would make the next one a part of the comment.
            {"asked", escaped(asked, Printed::one_line) + (asked.ends_with('\\') ? "." : "")},
            {"remark", std::string(program.language.remark)},
            // A file of tests has more to say here (reports/idioms).
            {"program", "reproducer"},
            {"and_libraries", ""},
            {"and_packages", ""},
            {"override", ""},
            {"case", ""},
            {"end", ""},
            {"test_name", ""},
            {"decorator", ""},
            {"turn_a_float", texts["a_along_y_float"]},
            {"turn_b_float", texts[(is_round ? "b_along_y" : "xyzw_b") + std::string("_float")]}});
  const auto part = [&](std::string_view source) { return fill_template(source, tags, texts); };
  const std::string_view shared = program.language.shared;
  texts["mjcf"] = part(mjcf_template);
  texts["head"] = part(head_template);
  texts["answer"] = part(section(shared, sweep ? "cast answer" : "answer"));
  texts["question"] = part(section(shared, "question")) + '\n';
  if (has_floor(program)) texts["floor"] = part(section(shared, "floor")) + '\n';
  texts["verdict"] = part(section(shared, sweep ? "cast" : "contact"));
  texts["judgement"] = part(section(shared, "judgement"));
  return part(program.source) + '\n';
}

}  // namespace touchstone
