#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <memory>
#include <unistd.h>

#include "candidates/host/interruption.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"
#include "properties/files/disk.hpp"
#include "properties/named.hpp"
#include "reference/invalid_input.hpp"
#include "reports/idioms/idiom.hpp"
#include "reports/test_data/suite_2_casts.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {
namespace {

struct ExportArguments {
  explicit ExportArguments(Command& command)
      : sample(command, 20, 1000000000), bar(command), workers(command) {}
  SampleOption sample;
  BarOption bar;
  WorkersOption workers;
  std::string out = "-", format_name, idiom, engine, suite_2;
  std::uint64_t limit = 30;
  bool suite = false;

  bool is_suite() const { return suite || !suite_2.empty(); }
  CsvColumns columns() const {
    return !suite_2.empty() ? CsvColumns::suite_2 : suite ? CsvColumns::suite : CsvColumns::all;
  }

  Campaign campaign() const {
    if (is_suite() && (sample.is_narrowed() || sample.count_is_given())) {
      throw InvalidInput(suite ? "--suite" : "--suite-2",
                         "given with --pair, --class, --group or --count",
                         "must stand without them: it is always the same configurations");
    }
    Campaign c = suite ? suite_1() : sample.campaign();
    c.bar = bar.get();
    c.workers = workers.get();
    return c;
  }

  TestDataFormat format() const {
    if (!format_name.empty()) return parse_test_data_format(format_name, "--format");
    const std::string ending = std::filesystem::path(out).extension().string();
    if (out != "-" && !ending.empty()) {
      try {
        return parse_test_data_format(ending.substr(1), "--out");
      } catch (const InvalidInput&) {
        throw InvalidInput("--out", '"' + out + '"',
                           "must end in .jsonl, .csv or .npz, or stand beside --format");
      }
    }
    return is_suite() ? TestDataFormat::csv : TestDataFormat::json_lines;
  }
};

/// A text that is there in one piece.
int run_export_text(const ExportArguments& options, const std::function<std::string()>& make) {
  if (options.out != "-") check_file_writable(options.out, "--out");
  const std::string text = make();
  if (options.out == "-") {
    print(text);
  } else {
    write_file(options.out, text, "--out");
  }
  return 0;
}

/// Tests for an engine.
int run_export_tests(const ExportArguments& options) {
  if (options.engine.empty()) {
    throw InvalidInput("--engine", "missing", "must name the engine that is tested, as bullet");
  }
  return run_export_text(options, [&] {
    return idiom_file({options.idiom, options.engine, options.sample.pairs(), options.sample.seed(),
                       options.limit});
  });
}

constexpr std::string_view casts_file = "casts";

std::vector<std::string_view> suite_2_names() {
  std::vector<std::string_view> names;
  for (const SuiteFile& file : suite_2_files()) names.push_back(file.name);
  names.push_back(casts_file);
  return names;
}

/// The casts of touchstone-suite-2.
int run_export_casts(const ExportArguments& options) {
  if (options.format() != TestDataFormat::csv) {
    throw InvalidInput(options.format_name.empty() ? "--out" : "--format", "not CSV",
                       "must be csv for --suite-2 casts");
  }
  return run_export_text(options, [] { return cast_csv(suite_2_casts()); });
}

/// A file is written as a whole or not at all, standard output as it comes.
int run_export(const ExportArguments& options) {
  const Campaign campaign = options.campaign();
  if (!options.suite_2.empty()) {
    named(suite_2_names(), options.suite_2, "--suite-2", std::identity());
    if (options.suite_2 == casts_file) return run_export_casts(options);
  }
  const auto writer = test_data_writer(options.format(), options.columns());
  const bool streams = options.out == "-";
  if (streams && options.format() == TestDataFormat::npz && isatty(STDOUT_FILENO) != 0) {
    throw InvalidInput("--out", "a terminal",
                       "must be a file or a pipe for npz, which is binary; or choose another "
                       "--format");
  }
  if (!streams) check_file_writable(options.out, "--out");
  const Interruption interruption;
  std::string text;
  std::uint64_t count = 0;
  const auto take = [&](const TestDatum& datum) {
    text += writer->add(datum);
    ++count;
    if (!streams) return;
    std::fwrite(text.data(), 1, text.size(), stdout);
    text.clear();
  };
  if (options.suite_2.empty()) {
    make_test_data(campaign, take);
  } else {
    make_suite_2(named(suite_2_files(), options.suite_2, "--suite-2"), take);
  }
  if (interrupted()) {
    complain(streams ? "Interrupted: the rest is missing." : "Interrupted: no file was written.");
    return interrupted_exit_code();
  }
  text += writer->finish();
  if (streams) {
    std::fwrite(text.data(), 1, text.size(), stdout);
  } else {
    write_file(options.out, text, "--out");
    print(fmt::format("{}: {}\n", counted(count, "configuration"), options.out));
  }
  return 0;
}

}  // namespace

void add_export(Program& program) {
  Command command = program.command("export", "Write configurations with their truths");
  const auto options = std::make_shared<ExportArguments>(command);
  command.text("--out", "FILE", options->out,
               "File: .jsonl (JSON Lines), .csv or .npz (NumPy); - is standard output");
  command.text("--format", "FORMAT", options->format_name,
               "jsonl, csv or npz, whatever the file's name");
  command.flag("--suite", options->suite,
               "touchstone-suite-1, as suite/ has it, by default as CSV");
  command.text("--suite-2", "NAME", options->suite_2,
               "Likewise a file of touchstone-suite-2: smoke, everyday, hard or casts");
  const Option as = command.text(
      "--as", "IDIOM", options->idiom,
      fmt::format("Write a file of tests for an engine's project: {}", fmt::join(idioms(), ", ")));
  command.text("--engine", "ENGINE", options->engine, "The engine, as for replay --emit");
  command.count("--limit", options->limit, {1, 1000}, "At most so many tests");
  command.mode(as, {"--engine", "--limit"}, {"--pair", "--seed", "--out"});
  command.footer(
      "Examples:\n"
      "  touchstone export --out truth.csv\n"
      "  touchstone export --as gtest --engine bullet --out contacts_test.cpp\n"
      "  touchstone export --pair cylinder-box --count 100 --out truth.npz\n"
      "  touchstone export --suite | gzip -9n > touchstone-suite-1.csv.gz\n"
      "What the files hold: docs/your-poses.md.");
  command.runs(
      [options, as] { return as.is_given() ? run_export_tests(*options) : run_export(*options); });
}

}  // namespace touchstone
