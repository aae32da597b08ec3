#include "properties/laws/check.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "candidates/host/progress.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "properties/laws/failure_file.hpp"
#include "reference/invalid_input.hpp"
#include "reports/check_report.hpp"

namespace touchstone {
namespace {

constexpr int something_failed = 1;

/// About as much work: there is one hostile class, and of others some two hundred to a pair.
constexpr std::uint64_t usual_count = 20, usual_count_of_hostile = 5000;

struct Options {
  explicit Options(Command& command)
      : sample(command, usual_count, 1000000000), bar(command), workers(command) {}
  SampleOption sample;
  BarOption bar;
  WorkersOption workers;
  std::string candidate;
  std::vector<std::string> laws;
  bool hostile = false;
  std::string save, corpus, known, junit, json;

  CheckOptions check() const {
    CheckOptions c;
    for (const auto& name : laws) c.laws.push_back(&find_law(name));
    if (laws.empty()) {
      for (const Law& law : all_laws()) c.laws.push_back(&law);
    }
    c.pairs = sample.pairs();
    c.classes = hostile ? std::vector<std::string>{"hostile"} : sample.classes();
    c.groups = sample.groups();
    c.count = hostile && !sample.count_is_given() ? usual_count_of_hostile : sample.count();
    c.seed = sample.seed();
    c.bar = bar.get();
    c.workers = workers.get();
    c.by_features = !save.empty() || !known.empty();  // which takes twice as long
    return c;
  }
};

/// Asks for the failures that are saved there again: those of the candidate, or all if it is null.
std::vector<ReplayedFailure> replay_all(const std::string& path, const char* field,
                                        const Candidate* candidate) {
  if (path.empty()) return {};
  std::vector<Failure> failures = read_corpus(path, field);
  if (candidate) {
    std::erase_if(failures, [&](const Failure& f) { return f.candidate != candidate->name; });
  }
  std::vector<ReplayedFailure> replayed = replay(failures, {});
  fmt::print("{}:\n{}", path, corpus_text(replayed));
  return replayed;
}

/// Saves one failure of each cause, and says with which to start.
void save_all(const std::vector<LawResult>& results, const std::string& folder) {
  const std::vector<Failure> failures = in_order(results);
  if (failures.empty()) return;
  fmt::print("\nSaved, one of each cause; start with the first:\n");
  for (const Failure& f : failures) {
    fmt::print("  {}, {} configurations\n    {}\n", to_string(cause_of(f)), f.met,
               save(f, folder).string());
  }
}

bool has(const std::vector<ReplayedFailure>& failures, ReplayedFailure::Result result) {
  return std::any_of(failures.begin(), failures.end(),
                     [&](const ReplayedFailure& r) { return r.result == result; });
}

std::vector<ReplayedFailure> joined(std::vector<ReplayedFailure> first,
                                    const std::vector<ReplayedFailure>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

/// Known failures that still fail: one that is fixed excuses no other.
std::vector<Failure> still_failing(const std::vector<ReplayedFailure>& known) {
  std::vector<Failure> result;
  for (const ReplayedFailure& r : known) {
    if (r.result == ReplayedFailure::Result::as_expected) result.push_back(r.expected);
  }
  return result;
}

/// As they count in a run that knows them: what is fixed is welcome, what cannot be asked is not.
std::vector<ReplayedFailure> judged_as_known(std::vector<ReplayedFailure> known) {
  using Result = ReplayedFailure::Result;
  for (ReplayedFailure& r : known) {
    if (r.result == Result::fixed) r.result = Result::as_expected;
    if (r.result == Result::skipped) r.result = Result::changed;
  }
  return known;
}

/// Without the failures that are known.
std::vector<LawResult> check_laws(const Candidate* candidate, const CheckOptions& checks,
                                  const std::vector<Failure>& known) {
  if (!candidate) return {};
  CandidateProcess process(*candidate, checks.bar.threshold);
  fmt::print("{} {}, seed {}, {} configurations of each pair and pose class, tolerance {}\n",
             process.candidate().name, process.candidate().version, checks.seed, checks.count,
             checks.bar.tolerance);
  std::unique_ptr<Progress> progress;
  auto results = check(process, checks, [&](std::uint64_t done, std::uint64_t all) {
    if (!progress) progress = std::make_unique<Progress>("configurations", all);
    progress->update(done);
  });
  progress.reset();
  if (!known.empty()) {
    const std::size_t all = in_order(results).size();
    results = new_ones(std::move(results), known);
    fmt::print("{} of {} causes of failures are known and not shown\n",
               all - in_order(results).size(), all);
  }
  fmt::print("{}", check_text(results, standard_output()));
  return results;
}

int run(const Options& options) {
  if (options.candidate.empty() && options.corpus.empty() && options.known.empty()) {
    throw InvalidInput("--candidate", "nothing",
                       "must name what to check, or --corpus or --known a folder");
  }
  const CheckOptions checks = options.check();
  const Candidate* const candidate =
      options.candidate.empty() ? nullptr : &named_candidate(options.candidate);
  const std::string name = candidate ? candidate->name : "";
  const auto corpus = replay_all(options.corpus, "--corpus", candidate);
  const auto known = replay_all(options.known, "--known", candidate);
  const auto judged = joined(corpus, judged_as_known(known));
  const auto results = check_laws(candidate, checks, still_failing(known));
  if (!options.save.empty()) save_all(results, options.save);
  if (!options.junit.empty()) {
    write_file(options.junit, junit_xml(name, results, judged), "--junit");
  }
  if (!options.json.empty()) {
    write_file(options.json, check_json(name, checks, results, joined(corpus, known)), "--json");
  }
  const bool broken =
      std::any_of(results.begin(), results.end(), [](const LawResult& r) { return r.broken > 0; });
  const bool changed =
      has(judged, ReplayedFailure::Result::fixed) || has(judged, ReplayedFailure::Result::changed);
  return broken || changed ? something_failed : 0;
}

std::string law_list() {
  std::string text = "Laws:\n";
  for (const Law& law : all_laws()) text += list_entry(law.name, 11, law.statement);
  return text;
}

}  // namespace

void add_check(Program& program) {
  Command command = program.command("check", "Hold one candidate to the laws of contacts");
  const auto options = std::make_shared<Options>(command);
  command.text("--candidate", options->candidate, "Its name, or a plug-in's file")
      .value("CANDIDATE");
  command
      .flag("--hostile", options->hostile,
            fmt::format("On the pose class hostile alone, {} configurations of each pair unless "
                        "--count says otherwise",
                        usual_count_of_hostile))
      .excludes(options->sample.class_option());
  command.list("--law", options->laws, "Only these laws").value("LAW");
  command
      .text("--corpus", options->corpus,
            "First replay the failures saved in this folder, or in this file of JSON Lines: "
            "each must fail as it did")
      .value("PATH");
  command
      .text("--known", options->known,
            "Failures saved in this folder or file are expected: only new ones fail")
      .value("PATH");
  command.text("--save", options->save, "Save failures into this folder, one of each cause")
      .value("FOLDER");
  command.text("--junit", options->junit, "Write the result as JUnit XML").value("FILE");
  command.text("--json", options->json, "Write the result as JSON").value("FILE");
  command.footer(
      "Examples:\n"
      "  touchstone check --candidate bullet\n"
      "  touchstone check --candidate ./my_engine.so --save failures\n"
      "  touchstone check --candidate ./my_engine.so --hostile\n"
      "  touchstone check --candidate ./my_engine.so --known failures\n"
      "  touchstone check --corpus failures\n" +
      law_list() +
      "Exit code 1: a law was broken, or a saved failure has changed; with --known: a\n"
      "law was broken in a new way, or a known failure has changed or cannot be asked.");
  command.runs([options] { return run(*options); });
}

}  // namespace touchstone
