#include "reports/idioms/idiom.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <map>
#include <memory>

#include "candidates/candidates.hpp"
#include "candidates/npm_engines.hpp"
#include "properties/named.hpp"
#include "properties/pose_class.hpp"
#include "reference/invalid_input.hpp"
#include "reports/idioms/cases.hpp"
#include "reports/replay.hpp"
#include "reports/reproducer/fill_template.hpp"
#include "reports/reproducer/programs.hpp"

namespace touchstone {

// Made by the build from the files tests.*.in of candidates/reproducers.
extern const std::string_view tests_cpp_template;

namespace {

/// A framework of tests, in which files are written for the programs of a language.
struct Idiom {
  std::string_view name;
  const Language& language;
  const std::string_view& frame;
  Texts texts;  ///< of every file
};

const std::vector<Idiom>& all_idioms() {
  static const std::vector<Idiom> all = {{"gtest",
                                          cpp,
                                          tests_cpp_template,
                                          {{"program", "cylinder_contacts_test"},
                                           {"and_libraries", " -lgtest_main -lgtest"},
                                           {"and_packages", " libgtest-dev"},
                                           {"override", " override"}}}};
  return all;
}

/// Can its part that asks stand in a class, or a function, of its own for each pair?
bool fits(const Program& program, const Idiom& idiom) {
  return &program.language == &idiom.language &&
         program.source.find("@override@") != program.source.npos;
}

const Program& program_of(const Idiom& idiom, const std::string& engine) {
  std::vector<std::string_view> names;
  for (const Program& p : programs()) {
    if (!fits(p, idiom)) continue;
    if (p.engine == engine) return p;
    names.push_back(p.engine);
  }
  throw InvalidInput(
      "--engine", in_quotes(engine),
      fmt::format("must be one of {} for --as {}", fmt::join(names, ", "), idiom.name));
}

/// What asks the engine; nothing where it is not installed.
const Candidate* installed(const Program& program) {
  const NpmEngine* const engine = find_npm_engine(family_of(program.candidate));
  if (engine && !npm_obstacle(*engine).empty()) return nullptr;
  try {
    return &find_candidate(program.candidate);
  } catch (const InvalidInput&) {
    return nullptr;
  }
}

/// "RimFace" of "rim-face".
std::string camel_case(std::string_view name) {
  std::string result;
  for (const std::string_view word : split(name, '-')) {
    result += static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    result += word.substr(1);
  }
  return result;
}

/// A text as a comment, in lines of 100 columns.
std::string comment(std::string_view remark, std::string_view text) {
  constexpr std::size_t width = 100;
  std::string result, line(remark);
  for (const std::string_view word : split(text, ' ')) {
    if (line.size() + 1 + word.size() > width) {
      result += line + '\n';
      line = remark;
    }
    line += ' ' + std::string(word);
  }
  return result + line;
}

/// Each line that is not empty, moved to the right.
std::string indented(std::string_view text, std::size_t by) {
  std::string result;
  for (const std::string_view line : split(text, '\n')) {
    if (!result.empty()) result += '\n';
    if (!line.empty()) result += std::string(by, ' ') + std::string(line);
  }
  return result;
}

/// What the engine does in a case, as the end of a sentence.
std::string_view deed(const std::string& verdict) {
  static const std::map<std::string, std::string_view, std::less<>> deeds = {
      {"missed", "finds no contact"},
      {"phantom", "finds a contact where there is none"},
      {"shallow", "finds too small a depth"},
      {"overdeep", "finds too large a depth"},
      {"wrong-normal", "answers a direction along which the bodies overlap more"},
      {"not-finite", "answers what is no number"},
      {"off-body", "answers a point that is on neither body"},
      {"failed", "fails"}};
  return deeds.at(verdict);
}

Texts case_texts(const IdiomCase& c, const std::string& engine, const Idiom& idiom) {
  const PoseClass& of = c.identity.pose_class;
  Texts texts = question_texts(c.configuration, NumberStyle::decimal);
  std::string sentences = of.arrangement->description;
  if (c.verdict != "right") sentences += fmt::format(" {} {}.", engine, deed(c.verdict));
  sentences += fmt::format(" (Rounded from {}.)", to_string(c.identity));
  texts["sentences"] = comment(idiom.language.remark, sentences);
  texts["name"] = camel_case(of.arrangement->name);
  texts["true_distance"] = fmt::format("{}", nearest_to_middle(c.truth.signed_distance));
  texts["tolerance"] = fmt::format("{:.2g}", c.tolerance);
  texts["float_tolerance"] = fmt::format("{:.2g}", c.float_tolerance);
  texts["verdict"] = c.verdict;
  return texts;
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
  const Program& program = program_of(idiom, request.engine);
  const Candidate* const candidate = installed(program);
  std::unique_ptr<CandidateProcess> process;
  IdiomQuestion question{{}, request.seed, request.limit, request.bar, false, {}};
  for (const Pair pair : request.pairs) {
    if (knows(program, pair)) question.pairs.push_back(pair);
  }
  if (question.pairs.empty()) {
    throw InvalidInput("--pair", in_quotes(pair_name(request.pairs.front())),
                       fmt::format("must be one that {} knows", program.engine));
  }
  Tags tags = names_in(program.tags);
  question.is_single = std::find(tags.begin(), tags.end(), "float") != tags.end();
  if (candidate) {
    process = std::make_unique<CandidateProcess>(*candidate, request.bar.threshold, request.limits);
    question.ask = [&](const Configuration& c) { return process->answer(c); };
  }
  const std::vector<IdiomCase> cases = idiom_cases(question);

  const std::string version = candidate ? candidate->version : "(not installed)";
  Texts texts = idiom.texts;
  texts.merge(Texts{{"engine", std::string(program.title)},
                    {"engine_version", version},
                    {"command", command_of(request)},
                    {"single_precision", question.is_single ? "true" : "false"}});
  tags.insert(tags.end(), {"engine", idiom.name});
  Tags tags_of_all = tags;
  for (const IdiomCase& c : cases) {
    const std::string_view name = pair_name(pair_of(c.configuration));
    tags_of_all.push_back(name.substr(name.find('-') + 1));
  }
  const auto frame = [&](std::string_view name, const Tags& its_tags) {
    return fill_template(section(idiom.frame, name), its_tags, texts);
  };
  texts["answer"] = fill_template(section(idiom.language.shared, "answer"), tags, texts);
  texts["head"] = frame("head", tags);
  constexpr std::string_view asked = "@question@", judged = "@judgement@";
  const std::string_view source = program.source;
  const auto question_at = source.find(asked);
  const std::string_view once = source.substr(0, question_at);
  const std::string_view asking =
      source.substr(question_at + asked.size(), source.find(judged) - question_at - asked.size());
  std::string file = fill_template(once, tags_of_all, texts) + "\n\n" + frame("judge", tags) + "\n";
  std::string shape;
  for (const IdiomCase& c : cases) {
    for (auto& [name, text] : case_texts(c, fmt::format("{} {}", program.title, version), idiom))
      texts[name] = text;
    Tags tags_of_case = tags;
    tags_of_case.push_back(texts["shape_b"]);
    if (texts["shape_b"] != shape) {
      shape = texts["shape_b"];
      const std::string lines = fill_template(asking, tags_of_case, texts);
      texts["asking"] = indented(lines.substr(lines.find_first_not_of('\n')), 2);
      file += '\n' + frame("pair", tags_of_case) + '\n';
    }
    file += '\n' + frame("case", tags_of_case) + '\n';
  }
  return file + '\n' + frame("foot", tags) + '\n';
}

}  // namespace touchstone
