#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "properties/files/given_text.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace touchstone {

// The command line, read by CLI11, whose header only command.cpp and descriptions.cpp include: it
// costs seconds a file. Variables are set when the program runs; what stands in them before is the
// default that --help shows.

/// Exit codes: something failed its bar; bad input or usage.
inline constexpr int something_failed = 1, bad_input = 2;

/// An option or an argument of a command.
class Option {
 public:
  Option& required();
  Option& excludes(const Option& other);
  /// Puts it under a heading of its own in --help; without one --help does not show it, because
  /// only developers use it.
  Option& group(const std::string& heading);
  /// Says in words what the default is.
  Option& default_text(const std::string& text);
  /// "--count"
  std::string name() const;
  /// Is it on the command line? Known once the program runs.
  bool is_given() const;

 private:
  friend class Command;
  explicit Option(CLI::Option* option) : option_(option) {}
  CLI::Option* option_;
};

/// A subcommand. Names with leading dashes are options, others are arguments by position. `value`
/// is what --help calls the value, "PAIR"; completion offers what descriptions.cpp knows of that
/// name, and files otherwise.
class Command {
 public:
  /// Refused where it is empty.
  Option text(const std::string& name, const std::string& value, std::string& variable,
              const std::string& description);
  /// One argument, separated by commas.
  Option list(const std::string& name, const std::string& value, std::vector<std::string>& variable,
              const std::string& description);
  /// All that stands here.
  Option arguments(const std::string& name, const std::string& value,
                   std::vector<std::string>& variable, const std::string& description);
  Option flag(const std::string& name, bool& variable, const std::string& description);
  Option number(const std::string& name, double& variable, NumberRange range,
                const std::string& description);
  Option count(const std::string& name, std::uint64_t& variable, CountRange range,
               const std::string& description);
  /// Numbers separated by commas; the description says what they are by default.
  Option numbers(const std::string& name, std::vector<double>& variable, NumberRange range,
                 const std::string& description);
  /// An option that makes the command do something else. `own` options have a meaning beside it
  /// alone and stand under its heading in --help; of the others, `common` may stand beside it, as
  /// arguments by position may. Whatever would have no effect is refused.
  void mode(const Option& option, const std::vector<std::string>& own,
            const std::vector<std::string>& common);
  /// Examples and remarks, after the options in --help.
  void footer(const std::string& text);
  /// What the command does, after its modes are known; the value is the program's exit code.
  void runs(std::function<int()> action);

 private:
  friend class Program;
  Command(CLI::App* app, int* exit_code) : app_(app), exit_code_(exit_code) {}
  struct Mode {
    const CLI::Option* option;
    std::vector<std::string> own, common;
  };
  static void refuse_what_has_no_effect(const CLI::App& command, const std::vector<Mode>& modes);

  CLI::App* app_;
  int* exit_code_;
  std::vector<Mode> modes_;
};

class Program {
 public:
  Program(const std::string& name, const std::string& description);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  Command command(const std::string& name, const std::string& description);
  /// --version prints what `text` gives.
  void version(const std::function<std::string()>& text);
  /// An option that may stand before and after every subcommand, each time with one value, which
  /// --help calls `value`.
  void repeated(const std::string& name, const std::string& value,
                const std::function<void(const std::string&)>& each,
                const std::string& description);
  void footer(const std::string& text);

  /// Parses and runs the command that is named, or prints what --help and --version ask for. Throws
  /// InvalidInput on a usage error, and what a command throws.
  int run(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> app_;
  int exit_code_ = 0;
};

/// A line of a list in a footer, or several within 80 columns: a name in a column of this width and
/// what it is.
std::string list_entry(const std::string& name, std::size_t width, const std::string& text);

// The subcommands; each adds itself to the program.

void add_report(Program& program);
void add_replay(Program& program);
void add_solve(Program& program);
void add_check(Program& program);
void add_export(Program& program);
void add_score(Program& program);
void add_compare(Program& program);
void add_campaign(Program& program);
void add_simulate(Program& program);
void add_choose(Program& program);
void add_stability(Program& program);
void add_list(Program& program);

// The program's own description of its commands, in other forms than --help
// (descriptions.cpp).

std::vector<std::string> command_names(const CLI::App& program);
/// Those that may stand after this subcommand, the program's own and hidden ones included.
std::vector<const CLI::Option*> options_of(const CLI::App& command);

/// The manual page, in troff with the man macros, as UTF-8.
std::string manual(const CLI::App& program);

/// Completion scripts: subcommands, options, their values, files.
std::string bash_completion(const CLI::App& program);
std::string zsh_completion(const CLI::App& program);

// Standard streams:

/// Gives the standard streams that were closed (`>&-`) a descriptor on which every read or write
/// fails. Without it the next file or socket to be opened would be standard output, and what is
/// printed would end up in there. Comes before anything else in main.
void open_closed_streams();

/// Empties the buffers of standard output: was everything printed there really written? If not,
/// says why on standard error.
///
/// A pipe whose reader has ended (`touchstone list candidates | head -n 1`) ends the program at the
/// next write by SIGPIPE, quietly, as it does other programs (status 141 of a shell); where a
/// parent has ignored SIGPIPE, it is an output that cannot be written.
bool standard_output_is_written();

/// Runs `write`, which writes what was found into files, and prints it. Where it cannot be written
/// it is printed all the same, before the error goes on: it may have taken long to find.
void write_then_print(const std::function<void()>& write, const std::string& text);

/// To standard output, where nothing that came from outside is taken for a terminal's command or
/// stays unseen (candidates/readable.hpp). JSON keeps its meaning.
void print(const std::string& text);

/// To standard error, likewise, with a newline. What cannot be written there is lost: there is
/// nobody to tell.
void complain(const std::string& text);

}  // namespace touchstone
