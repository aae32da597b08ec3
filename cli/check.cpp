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
constexpr std::uint64_t usual_count = 2, usual_count_of_hostile = 500;

struct Options {
  explicit Options(Command& command) : sample(command, usual_count, 1000000000), bar(command) {}
  SampleOption sample;
  BarOption bar;
  std::string candidate;
  std::vector<std::string> laws;
  bool hostile = false;
  std::string save, corpus, junit, json;

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
    return c;
  }
};

/// Replays the failures of the candidate, or all of them if it is null.
std::vector<ReplayedFailure> replay_corpus(const Options& options, const Candidate* candidate) {
  if (options.corpus.empty()) return {};
  std::vector<Failure> corpus = read_corpus(options.corpus);
  if (candidate) {
    std::erase_if(corpus, [&](const Failure& f) { return f.candidate != candidate->name; });
  }
  std::vector<ReplayedFailure> replayed = replay(corpus, {});
  fmt::print("{}:\n{}", options.corpus, corpus_text(replayed));
  return replayed;
}

std::vector<LawResult> check_laws(const Candidate* candidate, const CheckOptions& checks) {
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
  fmt::print("{}", check_text(results));
  return results;
}

int run(const Options& options) {
  if (options.candidate.empty() && options.corpus.empty()) {
    throw InvalidInput("--candidate", "nothing", "must name what to check, or --corpus a folder");
  }
  const CheckOptions checks = options.check();
  const Candidate* const candidate =
      options.candidate.empty() ? nullptr : &named_candidate(options.candidate);
  const auto corpus = replay_corpus(options, candidate);
  const auto results = check_laws(candidate, checks);
  if (!options.save.empty()) {
    for (const LawResult& result : results) {
      for (const Failure& failure : result.failures) {
        fmt::print("saved {}\n", save(failure, options.save).string());
      }
    }
  }
  if (!options.junit.empty()) {
    write_file(options.junit, junit_xml(options.candidate, results, corpus), "--junit");
  }
  if (!options.json.empty()) {
    write_file(options.json, check_json(options.candidate, checks, results, corpus), "--json");
  }
  const bool broken =
      std::any_of(results.begin(), results.end(), [](const LawResult& r) { return r.broken > 0; });
  const bool changed = std::any_of(corpus.begin(), corpus.end(), [](const ReplayedFailure& r) {
    return r.result == ReplayedFailure::Result::fixed ||
           r.result == ReplayedFailure::Result::changed;
  });
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
  command.text("--candidate", options->candidate, "Its name, or a plug-in's file");
  command
      .flag("--hostile", options->hostile,
            fmt::format("On the pose class hostile alone, {} configurations of each pair unless "
                        "--count says otherwise",
                        usual_count_of_hostile))
      .excludes(options->sample.class_option());
  command.list("--law", options->laws, "Only these laws");
  command.text("--corpus", options->corpus,
               "First replay the failures saved in this folder, or in this file of JSON Lines: "
               "each must fail as it did");
  command.text("--save", options->save, "Save failures into this folder, one file each");
  command.text("--junit", options->junit, "Write the result as JUnit XML");
  command.text("--json", options->json, "Write the result as JSON");
  command.footer(
      "Examples:\n"
      "  touchstone check --candidate bullet\n"
      "  touchstone check --candidate ./my_engine.so --save failures\n"
      "  touchstone check --candidate ./my_engine.so --hostile\n"
      "  touchstone check --corpus failures\n" +
      law_list() + "Exit code 1: a law was broken, or a saved failure has changed.");
  command.runs([options] { return run(*options); });
}

}  // namespace touchstone
