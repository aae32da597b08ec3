#include "properties/laws/check.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "candidates/host/progress.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "properties/laws/cast_laws.hpp"
#include "properties/laws/failure_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/check_output.hpp"
#include "reports/search.hpp"

namespace touchstone {
namespace {

/// About as much work: there is one hostile class, and of others some two hundred to a pair.
constexpr std::uint64_t usual_count_of_class = 20, usual_count_of_hostile = 5000;
constexpr std::uint64_t usual_evaluations = 10000;
/// What an engine should hold; few are built for extreme poses.
constexpr Group usual_groups[] = {Group::everyday, Group::degenerate, Group::recorded};

struct CheckArguments {
  explicit CheckArguments(Command& command)
      : sample(command, usual_count_of_class, 1000000000), bar(command), workers(command) {}
  SampleOption sample;
  BarOption bar;
  WorkersOption workers;
  std::string candidate;
  std::vector<std::string> laws, goals;
  bool hostile = false, json = false, searches = false;
  std::string save, corpus, known, junit;

  CheckOptions check() const {
    CheckOptions c;
    for (const auto& name : laws) {
      if (!find_cast_law(name)) add_once(c.laws, &find_law(name));
    }
    if (laws.empty()) {
      for (const Law& law : all_laws()) c.laws.push_back(&law);
    }
    c.pairs = sample.pairs();
    c.classes = hostile ? std::vector<std::string>{"hostile"} : sample.classes();
    c.groups = sample.groups();
    if (!hostile && !sample.has_some_classes()) {
      c.groups.assign(std::begin(usual_groups), std::end(usual_groups));
    }
    c.count = hostile && !sample.count_is_given() ? usual_count_of_hostile : sample.count();
    c.seed = sample.seed();
    c.bar = bar.get();
    c.workers = workers.get();
    c.by_features = !save.empty() || !known.empty();  // which takes twice as long
    return c;
  }

  std::vector<const CastLaw*> cast_laws() const {
    std::vector<const CastLaw*> chosen;
    for (const CastLaw& law : all_cast_laws()) {
      if (laws.empty() || std::ranges::count(laws, law.name) > 0) chosen.push_back(&law);
    }
    return chosen;
  }

  Search search() const {
    Search s;
    s.pairs = sample.pairs();
    for (const std::string& name : goals) add_once(s.goals, parse_goal(name));
    if (goals.empty()) s.goals.assign(usual_goals.begin(), usual_goals.end());
    s.starts = {sample.classes(), sample.groups()};
    s.seed = sample.seed();
    s.budget = sample.count_is_given() ? sample.count() : usual_evaluations;
    s.bar = bar.get();
    s.workers = workers.get();
    return s;
  }
};

/// Shows how much of `work` is done, as often as that tells.
template <class Work>
auto with_progress(const char* unit, Work work) {
  std::optional<Progress> progress;
  return work([&](std::uint64_t done, std::uint64_t all) {
    if (!progress) progress.emplace(unit, all);
    progress->update(done);
  });
}

[[noreturn]] void refuse_without_routine(const std::string& candidate) {
  throw InvalidInput("--candidate", candidate, "must have a routine for a pair that is asked");
}

/// Prints what a person reads, as it comes, unless JSON is asked for.
struct Teller {
  bool is_silent;
  void tell(const std::string& text) const {
    if (!is_silent) print(text);
  }
};

/// Asks for the failures that are saved there again: those of the candidate, or all if it is null.
std::vector<ReplayedFailure> replay_all(const std::string& path, const char* field,
                                        const Candidate* candidate, const Teller& teller) {
  if (path.empty()) return {};
  std::vector<Failure> failures = read_corpus(path, field);
  // What has no failures would succeed for ever; where they are known, it is what one hopes for.
  if (failures.empty() && field == std::string_view("--corpus")) {
    throw InvalidInput(field, '"' + path + '"',
                       "must have a saved failure, a .json or .jsonl file");
  }
  if (candidate) {
    std::erase_if(failures, [&](const Failure& f) { return f.candidate != candidate->name; });
  }
  std::vector<ReplayedFailure> replayed = replay(failures, {});
  teller.tell(path + ":\n" + corpus_text(replayed, standard_output()));
  return replayed;
}

/// Saves one failure of each cause, and says with which to start.
void save_all(const std::vector<LawResult>& results, const std::string& folder,
              const Teller& teller) {
  const std::vector<Failure> failures = in_order(results);
  if (failures.empty()) return;
  teller.tell("\nSaved, one of each cause; start with the first:\n");
  for (const Failure& f : failures) {
    teller.tell(standard_output().below(fmt::format("{}, {}", to_string(cause_of(f)),
                                                    counted(f.met, "configuration"))) +
                "    " + save(f, folder).string() + '\n');
  }
}

/// Known failures that still fail: one that is fixed excuses no other.
std::vector<Failure> still_failing(const std::vector<ReplayedFailure>& known) {
  std::vector<Failure> result;
  for (const ReplayedFailure& r : known) {
    if (r.result == ReplayedFailure::Result::as_expected) result.push_back(r.expected);
  }
  return result;
}

/// " of everyday, degenerate, recorded poses"; empty where all are meant.
std::string groups_text(const std::vector<Group>& groups) {
  std::vector<std::string> names;
  for (const Group group : groups) names.emplace_back(group_name(group));
  return names.empty() ? "" : fmt::format(" of {} poses", fmt::join(names, ", "));
}

/// Tells what is new; failures that are known are counted apart.
std::vector<LawResult> told(std::vector<LawResult> results, const std::vector<Failure>& known,
                            const Teller& teller) {
  const Terminal terminal = standard_output();
  if (!known.empty()) {
    const std::size_t all = in_order(results).size();
    results = new_ones(std::move(results), known);
    teller.tell(terminal.folded(fmt::format("{} of {} causes of failures are known and not shown",
                                            all - in_order(results).size(), all)));
  }
  teller.tell(check_text(results, terminal));
  return results;
}

std::vector<LawResult> check_laws(const Candidate& candidate, const CheckOptions& checks,
                                  const std::vector<Failure>& known, const Teller& teller) {
  CandidateProcess process(candidate, checks.bar.threshold);
  const Terminal terminal = standard_output();
  teller.tell(terminal.folded(fmt::format(
      "{} {}, seed {}, {} of each pair and pose class{}, tolerance {}",
      shown_name(process.candidate().name), process.candidate().version, checks.seed,
      counted(checks.count, "configuration"), groups_text(checks.groups), checks.bar.tolerance)));
  auto results = with_progress("configurations",
                               [&](const auto& tell) { return check(process, checks, tell); });
  results = told(std::move(results), known, teller);
  if (std::none_of(results.begin(), results.end(), [](auto& r) { return r.tried > 0; })) {
    refuse_without_routine(process.candidate().name);
  }
  return results;
}

int run_search(const CheckArguments& options) {
  if (!options.save.empty()) check_writable(options.save, "--save");
  const Search wanted = options.search();
  const Candidate& candidate = named_candidate(options.candidate);
  const SearchResult result = with_progress(
      "evaluations", [&](const auto& tell) { return search(candidate, wanted, tell); });
  if (result.goals.empty()) refuse_without_routine(candidate.name);
  std::string saved;
  const auto write = [&] {
    if (options.save.empty()) return;
    for (const Failure& f : result.failures) {
      saved += "saved " + save(f, options.save).string() + '\n';
    }
  };
  write_then_print(write, options.json ? to_json(result).dump(1) + '\n'
                                       : search_text(result, candidate.name, standard_output()));
  if (!options.json) print(saved);
  return result.failures.empty() ? 0 : something_failed;
}

int run_check(const CheckArguments& options) {
  if (options.candidate.empty() && options.corpus.empty() && options.known.empty()) {
    throw InvalidInput("--candidate", "missing",
                       "must be given: a name, as bullet (touchstone list candidates shows them), "
                       "or the file of a plug-in; or else --corpus or --known with saved failures");
  }
  if (options.searches) return run_search(options);
  if (!options.junit.empty()) check_file_writable(options.junit, "--junit");
  if (!options.save.empty()) check_writable(options.save, "--save");
  const CheckOptions checks = options.check();
  const Candidate* const candidate =
      options.candidate.empty() ? nullptr : &named_candidate(options.candidate);
  const Teller teller{options.json};
  CheckResult result{candidate ? candidate->name : "",
                     replay_all(options.corpus, "--corpus", candidate, teller)};
  result.known = replay_all(options.known, "--known", candidate, teller);
  const std::vector<Failure> known = still_failing(result.known);
  if (candidate && !checks.laws.empty())
    result.laws = check_laws(*candidate, checks, known, teller);
  const auto cast_laws = options.cast_laws();
  if (candidate && !cast_laws.empty()) {
    auto casts = told(check_casts(*candidate, cast_laws, checks), known, teller);
    if (checks.laws.empty() && casts.empty()) {
      throw InvalidInput("--law", in_quotes(options.laws.front()),
                         "must be a law of contacts: " + candidate->name + " has no casts");
    }
    std::ranges::move(casts, std::back_inserter(result.laws));
  }
  if (!options.save.empty()) save_all(result.laws, options.save, teller);
  if (!options.junit.empty()) write_file(options.junit, junit_xml(result), "--junit");
  if (options.json) print(check_json(result, checks).dump(2) + '\n');
  return result.has_failed() ? something_failed : 0;
}

std::string law_list() {
  std::string text = "Laws:\n";
  for (const Law& law : all_laws()) text += list_entry(law.name, 13, law.statement);
  for (const CastLaw& law : all_cast_laws()) text += list_entry(law.name, 13, law.statement);
  return text;
}

std::string goal_list() {
  return "Goals of --search, each what is made as large as can be:\n" +
         list_entry("distance", 11, "the error of the signed distance") +
         list_entry("normal", 11, "the normal regret") +
         list_entry("points", 11, "the error of the deepest point's depth") +
         list_entry("hull", 11,
                    "how far the hull of the points moves at a step that cannot be seen") +
         list_entry("time", 11, "what a query takes; only where it is named");
}

}  // namespace

void add_check(Program& program) {
  Command command = program.command("check", "Hold one candidate to laws; climb to its worst");
  const auto options = std::make_shared<CheckArguments>(command);
  command.text("--candidate", "CANDIDATE", options->candidate, "Its name, or a plug-in's file");
  command
      .flag("--hostile", options->hostile,
            fmt::format("On the pose class hostile alone, {} configurations of each pair unless "
                        "--count says otherwise",
                        usual_count_of_hostile))
      .group("")
      .excludes(options->sample.class_option())
      .excludes(options->sample.group_option());
  command.list("--law", "LAW", options->laws, "Only these laws");
  command.text("--corpus", "PATH", options->corpus,
               "First replay the failures saved in this folder, or in this file of JSON Lines: "
               "each must fail as it did");
  command.text("--known", "PATH", options->known,
               "Failures saved in this folder or file are expected: only new ones fail");
  command.text("--save", "FOLDER", options->save,
               "Save failures into this folder, one of each cause");
  command.text("--junit", "FILE", options->junit, "Write the result as JUnit XML");
  command.flag("--json", options->json, "Print one JSON object instead of text");
  const Option search = command.flag(
      "--search", options->searches,
      fmt::format("Climb to its worst configurations instead, with {} evaluations for each pair "
                  "and goal unless --count says otherwise",
                  usual_evaluations));
  command.list("--goal", "GOAL", options->goals,
               "Only these goals (default: distance,normal,points,hull)");
  command.mode(search, {"--goal"},
               {"--candidate", "--save", "--json", "--pair", "--class", "--group", "--count",
                "--seed", "--tolerance", "--threshold", "--workers"});
  command.footer(
      "Examples:\n"
      "  touchstone check --candidate bullet\n"
      "  touchstone check --candidate ./my_engine.so --save failures\n"
      "  touchstone check --candidate ./my_engine.so --known failures\n"
      "  touchstone check --corpus failures\n"
      "  touchstone check --search --candidate bullet --pair cylinder-box\n"
      "  touchstone check --search --candidate reference --tolerance 1e-13 --count 1e6\n"
      "Without --group and --class it draws everyday, degenerate and recorded poses; a search\n"
      "starts from all.\n" +
      law_list() + goal_list() +
      "Exit code 1: a law was broken, or a saved failure has changed; with --known: a\n"
      "law was broken in a new way, or a known failure has changed or cannot be asked.");
  command.runs([options] { return run_check(*options); });
}

}  // namespace touchstone
