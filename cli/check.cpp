#include "properties/laws/check.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include <nlohmann/json.hpp>

#include "candidates/host/progress.hpp"
#include "cli/command.hpp"
#include "cli/failure_text.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/laws/failure_file.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// "3 missed, 1 shallow; known: 12 missed".
std::string counts_text(const LawResult& result) {
  const auto listed = [](const std::map<std::string, std::uint64_t>& counts) {
    std::string text;
    for (const auto& [name, count] : counts) {
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, name);
    }
    return text;
  };
  std::string text = listed(result.counts);
  if (result.known.empty()) return text;
  return text + (text.empty() ? "" : "; ") + "known: " + listed(result.known);
}

std::string xml_escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

const char* result_name(ReplayedFailure::Result result) {
  switch (result) {
    case ReplayedFailure::Result::as_expected:
      return "as expected";
    case ReplayedFailure::Result::fixed:
      return "fixed";
    case ReplayedFailure::Result::changed:
      return "changed";
    case ReplayedFailure::Result::skipped:
      return "skipped";
  }
  return "";
}

/// Whether it fails a run. A failure that is known may be fixed, but has to be asked.
bool is_failing(const ReplayedFailure& r, bool is_known) {
  using Result = ReplayedFailure::Result;
  return r.result == Result::changed || r.result == (is_known ? Result::skipped : Result::fixed);
}

std::string corpus_name(const Failure& f) {
  return fmt::format("{}, {}, {}, {}{}{}", f.candidate, pair_name(pair_of(f.configuration)), f.law,
                     f.violation.failure, f.features.empty() ? "" : ", ", f.features);
}

/// What came of a law, beside its name or, on a narrow terminal, below it.
std::string law_text(const LawResult& r, const Terminal& terminal) {
  constexpr std::size_t verdict_at = 29, counts_at = 46, min_room = 24;
  const std::string verdict = r.broken > 0      ? fmt::format("broken by {}", r.broken)
                              : r.known.empty() ? "passed"
                                                : "nothing new";
  const auto coloured = [&](const std::string& text) {
    if (r.broken > 0) return terminal.bad(text);
    return r.known.empty() ? terminal.good(text) : text;
  };
  const std::string name = fmt::format("  {:<13}{:>6} tried", r.law->name, r.tried);
  const std::string counts = counts_text(r);
  if (!counts.empty() && terminal.columns >= counts_at + min_room) {
    const std::string beside =
        wrapped(counts, terminal.columns - counts_at, '\n' + std::string(counts_at, ' '));
    return name + "  " + coloured(fmt::format("{:<16}", verdict)) + ' ' + beside + '\n';
  }
  std::string text = terminal.columns >= verdict_at + verdict.size()
                         ? name + "  " + coloured(verdict) + '\n'
                         : name + "\n    " + coloured(verdict) + '\n';
  return counts.empty() ? text
                        : text + "    " + wrapped(counts, terminal.columns - 4, "\n    ") + '\n';
}

/// A line for each law and pair, and the first failure of each with what is needed to see it again,
/// in the order of their groups.
std::string check_text(const std::vector<LawResult>& results, const Terminal& terminal) {
  std::string text;
  const char* last = "";
  for (const LawResult& r : results) {
    const char* pair = pair_name(r.pair);
    if (pair != last) text += '\n' + terminal.heading(pair) + '\n';
    if (r.tried == 0) {
      if (pair != last) text += terminal.below("no routine: no law was tried");
      last = pair;
      continue;
    }
    if (pair != last && r.unsupported > 0) {
      text += terminal.below(fmt::format("no routine for {}, which no law was tried on",
                                         counted(r.unsupported, "configuration")));
    }
    last = pair;
    text += law_text(r, terminal);
  }
  std::vector<const Failure*> firsts;
  for (const LawResult& r : results) {
    if (!r.failures.empty()) firsts.push_back(&r.failures.front());
  }
  std::stable_sort(firsts.begin(), firsts.end(), [](const Failure* a, const Failure* b) {
    return order_of(group_met(*a)) < order_of(group_met(*b));
  });
  for (const Failure* f : firsts) text += '\n' + failure_text(*f, terminal);
  return text;
}

std::string corpus_text(const std::vector<ReplayedFailure>& corpus, const Terminal& terminal) {
  std::string text;
  for (const ReplayedFailure& r : corpus) {
    const bool is_known = r.now.empty() || r.result == ReplayedFailure::Result::as_expected;
    const std::string name =
        corpus_name(r.expected) + (is_known ? "" : fmt::format(" ({})", r.now));
    text += fmt::format("  {:<12} {}\n", result_name(r.result),
                        wrapped(name, terminal.columns - 15, '\n' + std::string(15, ' ')));
  }
  return text;
}

/// For continuous integration: a test suite per candidate, a test case per law and pair, and one
/// per saved failure. What is known is skipped and says so, as pytest writes failures that are
/// expected, for JUnit has no word of its own.
std::string junit_xml(const std::string& candidate, const std::vector<LawResult>& results,
                      const std::vector<ReplayedFailure>& corpus,
                      const std::vector<ReplayedFailure>& known) {
  const Terminal unbounded{.columns = 1000000};
  std::string cases;
  int failures = 0, skipped = 0;
  const auto skip = [&](const std::string& message) {
    ++skipped;
    cases += fmt::format("<skipped message=\"{}\"/>", xml_escaped(message));
  };
  double seconds = 0;
  for (const LawResult& r : results) {
    seconds += r.seconds;
    cases += fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\" time=\"{:.3f}\">",
                         xml_escaped(candidate), pair_name(r.pair), r.law->name, r.seconds);
    if (r.tried == 0) skip("no routine for the pair");
    if (r.broken == 0 && !r.known.empty()) skip(counts_text(r));
    if (r.broken > 0) {
      ++failures;
      cases += fmt::format("<failure type=\"{}\" message=\"{}\">{}</failure>",
                           xml_escaped(r.failures.front().violation.failure),
                           xml_escaped(counts_text(r)),
                           xml_escaped(failure_text(r.failures.front(), unbounded)));
    }
    cases += "</testcase>\n";
  }
  using Result = ReplayedFailure::Result;
  const auto add_saved = [&](const ReplayedFailure& r, const char* kind, bool is_known) {
    cases +=
        fmt::format("    <testcase classname=\"{}.{}\" name=\"{}\">",
                    xml_escaped(r.expected.candidate), kind, xml_escaped(corpus_name(r.expected)));
    if (is_failing(r, is_known)) {
      ++failures;
      cases += fmt::format("<failure type=\"{}\">{}</failure>", result_name(r.result),
                           xml_escaped(r.now));
    } else if (r.result == Result::skipped) {
      skip(r.now);
    } else if (is_known && r.result == Result::as_expected) {
      skip("known: " + r.now);
    }
    cases += "</testcase>\n";
  };
  for (const ReplayedFailure& r : corpus) add_saved(r, "corpus", false);
  for (const ReplayedFailure& r : known) add_saved(r, "known", true);
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n"
      "  <testsuite name=\"touchstone check\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" "
      "time=\"{:.3f}\">\n{}"
      "  </testsuite>\n</testsuites>\n",
      results.size() + corpus.size() + known.size(), failures, skipped, seconds, cases);
}

/// One JSON object (docs/check.md).
std::string check_json(const std::string& candidate, const CheckOptions& options,
                       const std::vector<LawResult>& results,
                       const std::vector<ReplayedFailure>& corpus,
                       const std::vector<ReplayedFailure>& known) {
  json laws = json::array(), groups = json::array();
  for (const Group group : options.groups) groups.push_back(group_name(group));
  for (const LawResult& r : results) {
    json failures = json::array();
    for (const Failure& f : r.failures) failures.push_back(to_json(f));
    laws.push_back({{"law", r.law->name},
                    {"pair", pair_name(r.pair)},
                    {"tried", r.tried},
                    {"unsupported", r.unsupported},
                    {"broken", r.broken},
                    {"outcomes", r.counts},
                    {"known", r.known},
                    {"failures", failures}});
  }
  json saved = json::array();
  for (const auto* all : {&corpus, &known}) {
    for (const ReplayedFailure& r : *all) {
      json& entry = saved.emplace_back(to_json(r.expected));
      entry["result"] = result_name(r.result);
      entry["now"] = r.now;
      entry["known"] = all == &known;
    }
  }
  const json result = {{"schema", "touchstone-check-1"},
                       {"candidate", candidate},
                       {"seed", options.seed},
                       {"count", options.count},
                       {"groups", groups},
                       {"tolerance", options.bar.tolerance},
                       {"threshold", options.bar.threshold},
                       {"laws", laws},
                       {"corpus", saved}};
  return result.dump(2) + '\n';
}

/// About as much work: there is one hostile class, and of others some two hundred to a pair.
constexpr std::uint64_t usual_count_of_class = 20, usual_count_of_hostile = 5000;
/// What an engine should hold; few are built for extreme poses.
constexpr Group usual_groups[] = {Group::everyday, Group::degenerate, Group::recorded};

struct CheckArguments {
  explicit CheckArguments(Command& command)
      : sample(command, usual_count_of_class, 1000000000), bar(command), workers(command) {}
  SampleOption sample;
  BarOption bar;
  WorkersOption workers;
  std::string candidate;
  std::vector<std::string> laws;
  bool hostile = false, json = false;
  std::string save, corpus, known, junit;

  CheckOptions check() const {
    CheckOptions c;
    for (const auto& name : laws) add_once(c.laws, &find_law(name));
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
};

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

bool fails(const std::vector<ReplayedFailure>& failures, bool are_known) {
  return std::any_of(failures.begin(), failures.end(),
                     [&](const ReplayedFailure& r) { return is_failing(r, are_known); });
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

/// Failures that are known are counted apart.
std::vector<LawResult> check_laws(const Candidate* candidate, const CheckOptions& checks,
                                  const std::vector<Failure>& known, const Teller& teller) {
  if (!candidate) return {};
  CandidateProcess process(*candidate, checks.bar.threshold);
  const Terminal terminal = standard_output();
  teller.tell(terminal.folded(fmt::format(
      "{} {}, seed {}, {} of each pair and pose class{}, tolerance {}", process.candidate().name,
      process.candidate().version, checks.seed, counted(checks.count, "configuration"),
      groups_text(checks.groups), checks.bar.tolerance)));
  std::unique_ptr<Progress> progress;
  auto results = check(process, checks, [&](std::uint64_t done, std::uint64_t all) {
    if (!progress) progress = std::make_unique<Progress>("configurations", all);
    progress->update(done);
  });
  progress.reset();
  if (!known.empty()) {
    const std::size_t all = in_order(results).size();
    results = new_ones(std::move(results), known);
    teller.tell(terminal.folded(fmt::format("{} of {} causes of failures are known and not shown",
                                            all - in_order(results).size(), all)));
  }
  teller.tell(check_text(results, terminal));
  if (std::none_of(results.begin(), results.end(), [](auto& r) { return r.tried > 0; })) {
    throw InvalidInput("--candidate", process.candidate().name,
                       "must have a routine for a pair that is asked");
  }
  return results;
}

int run_check(const CheckArguments& options) {
  if (options.candidate.empty() && options.corpus.empty() && options.known.empty()) {
    throw InvalidInput("--candidate", "missing",
                       "must be given: a name, as bullet (touchstone candidates lists them), or "
                       "the file of a plug-in; or else --corpus or --known with saved failures");
  }
  if (!options.junit.empty()) check_file_writable(options.junit, "--junit");
  if (!options.save.empty()) check_writable(options.save, "--save");
  const CheckOptions checks = options.check();
  const Candidate* const candidate =
      options.candidate.empty() ? nullptr : &named_candidate(options.candidate);
  const std::string name = candidate ? candidate->name : "";
  const Teller teller{options.json};
  const auto corpus = replay_all(options.corpus, "--corpus", candidate, teller);
  const auto known = replay_all(options.known, "--known", candidate, teller);
  const auto results = check_laws(candidate, checks, still_failing(known), teller);
  if (!options.save.empty()) save_all(results, options.save, teller);
  if (!options.junit.empty()) {
    write_file(options.junit, junit_xml(name, results, corpus, known), "--junit");
  }
  if (options.json) print(check_json(name, checks, results, corpus, known));
  const bool broken =
      std::any_of(results.begin(), results.end(), [](const LawResult& r) { return r.broken > 0; });
  return broken || fails(corpus, false) || fails(known, true) ? something_failed : 0;
}

std::string law_list() {
  std::string text = "Laws:\n";
  for (const Law& law : all_laws()) text += list_entry(law.name, 11, law.statement);
  return text;
}

}  // namespace

void add_check(Program& program) {
  Command command = program.command("check", "Hold one candidate to the laws of contacts");
  const auto options = std::make_shared<CheckArguments>(command);
  command.text("--candidate", options->candidate, "Its name, or a plug-in's file")
      .value("CANDIDATE");
  command
      .flag("--hostile", options->hostile,
            fmt::format("On the pose class hostile alone, {} configurations of each pair unless "
                        "--count says otherwise",
                        usual_count_of_hostile))
      .excludes(options->sample.class_option())
      .excludes(options->sample.group_option());
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
  command.flag("--json", options->json, "Print one JSON object instead of text");
  command.footer(
      "Examples:\n"
      "  touchstone check --candidate bullet\n"
      "  touchstone check --candidate ./my_engine.so --save failures\n"
      "  touchstone check --candidate ./my_engine.so --hostile\n"
      "  touchstone check --candidate ./my_engine.so --known failures\n"
      "  touchstone check --corpus failures\n"
      "Without --group, --class and --hostile it draws everyday, degenerate and recorded poses.\n" +
      law_list() +
      "Exit code 1: a law was broken, or a saved failure has changed; with --known: a\n"
      "law was broken in a new way, or a known failure has changed or cannot be asked.");
  command.runs([options] { return run_check(*options); });
}

}  // namespace touchstone
