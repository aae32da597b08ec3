#include "cli/command.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <iostream>
#include <sstream>
#include <unistd.h>
#include <utility>

#include <CLI/CLI.hpp>

#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

constexpr std::size_t name_width = 24;
/// On a terminal narrower than this, descriptions stand below names.
constexpr std::size_t min_width_beside = 60, narrow_name_width = 6;

/// Options and subcommands within the terminal's columns, long descriptions on several lines.
class HelpFormat : public CLI::Formatter {
 public:
  explicit HelpFormat(std::size_t columns)
      : width_(columns < min_width_beside ? narrow_name_width : name_width), columns_(columns) {
    column_width(width_);
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    // CLI11 indents what follows a line's end.
    return wrapped(CLI::Formatter::make_option_desc(option), columns_ - width_, "\n");
  }

 private:
  std::size_t width_, columns_;
};

/// CLI11 would only say that a subcommand is required.
void refuse_unknown_command(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string names;
  for (const CLI::App* command : program.get_subcommands({})) {
    if (command->get_name() == argv[1]) return;
    names += (names.empty() ? "" : ", ") + command->get_name();
  }
  throw InvalidInput("subcommand", '"' + std::string(argv[1]) + '"', "must be one of " + names);
}

/// Prints what --help and --version ask for, errors to CLI11, or a usage error; its messages repeat
/// what was given.
int tell(const CLI::App& program, const CLI::ParseError& error) {
  constexpr int bad_usage = 2;
  constexpr std::size_t max_message = 400;
  std::ostringstream out, message;
  const int code = program.exit(error, out, message);
  std::fputs(out.str().c_str(), stdout);
  if (code == 0) return 0;
  std::istringstream lines(message.str());
  for (std::string line; std::getline(lines, line);) complain(printable(line, max_message));
  return bad_usage;
}

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}
Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}
Option& Option::group(const std::string& heading) {
  option_->group(heading);
  return *this;
}
Option& Option::value(const std::string& name) {
  option_->type_name(name);
  return *this;
}
Option& Option::default_text(const std::string& text) {
  option_->default_str(text);
  return *this;
}
bool Option::is_given() const { return option_->count() > 0; }

Option Command::text(const std::string& name, std::string& variable,
                     const std::string& description) {
  CLI::Option* option = app_->add_option(name, variable, description);
  if (!variable.empty()) option->capture_default_str();
  return Option(option);
}

Option Command::list(const std::string& name, std::vector<std::string>& variable,
                     const std::string& description) {
  return Option(
      app_->add_option(name, variable, description)->delimiter(',')->allow_extra_args(false));
}

Option Command::arguments(const std::string& name, std::vector<std::string>& variable,
                          const std::string& description) {
  return Option(app_->add_option(name, variable, description));
}

Option Command::flag(const std::string& name, bool& variable, const std::string& description) {
  return Option(app_->add_flag(name, variable, description));
}

Option Command::number(const std::string& name, double& variable, NumberRange range,
                       const std::string& description) {
  const auto read = [&variable, name, range](const std::string& text) {
    variable = read_number(name, text, range);
  };
  return Option(app_->add_option_function<std::string>(name, read, description)
                    ->type_name("FLOAT")
                    ->default_str(fmt::format("{}", variable)));
}

Option Command::count(const std::string& name, std::uint64_t& variable, CountRange range,
                      const std::string& description) {
  const auto read = [&variable, name, range](const std::string& text) {
    variable = read_count(name, text, range);
  };
  return Option(app_->add_option_function<std::string>(name, read, description)
                    ->type_name("UINT")
                    ->default_str(fmt::format("{}", variable)));
}

Option Command::numbers(const std::string& name, std::vector<double>& variable, NumberRange range,
                        const std::string& description) {
  const auto read = [&variable, name, range](const std::vector<std::string>& texts) {
    variable.clear();
    for (const auto& text : texts) variable.push_back(read_number(name, text, range));
  };
  return Option(app_->add_option_function<std::vector<std::string>>(name, read, description)
                    ->type_name("FLOAT")
                    ->delimiter(',')
                    ->allow_extra_args(false));
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::runs(std::function<int()> action) {
  app_->callback([action = std::move(action), code = exit_code_] { *code = action(); });
}

Program::Program(const std::string& name, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->add_flag_callback(
      "--manual",
      [this] {
        fmt::print("{}", manual(*app_));
        throw CLI::Success();
      },
      "Print the manual page in troff, as for man -l -");
  const auto complete = [this](const std::string& shell) {
    if (shell != "bash" && shell != "zsh") {
      throw InvalidInput("--completion", '"' + shell + '"', "must be bash or zsh");
    }
    fmt::print("{}", shell == "bash" ? bash_completion(*app_) : zsh_completion(*app_));
    throw CLI::Success();
  };
  app_->add_option_function<std::string>("--completion", complete,
                                         "Print what bash or zsh completes this program with")
      ->type_name("SHELL");
  app_->require_subcommand(1);
  app_->formatter(std::make_shared<HelpFormat>(standard_output().columns));
  app_->fallthrough();
}

Program::~Program() = default;

Command Program::command(const std::string& name, const std::string& description) {
  return {app_->add_subcommand(name, description), &exit_code_};
}

void Program::version(const std::function<std::string()>& text) {
  app_->set_version_flag("--version", text);
}

void Program::repeated(const std::string& name, const std::string& value,
                       const std::function<void(const std::string&)>& each,
                       const std::string& description) {
  const auto take = [each](const std::vector<std::string>& values) {
    for (const std::string& one : values) each(one);
  };
  app_->add_option_function<std::vector<std::string>>(name, take, description)
      ->type_name(value)
      ->allow_extra_args(false);
}

void Program::footer(const std::string& text) { app_->footer(text); }

int Program::run(int argc, char** argv) {
  refuse_unknown_command(*app_, argc, argv);
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return tell(*app_, e);
  }
  return exit_code_;
}

std::string list_entry(const std::string& name, std::size_t width, const std::string& text) {
  const std::size_t columns = standard_output().columns;
  const bool is_below = columns < min_width_beside;
  const std::size_t indent = is_below ? narrow_name_width : width + 4;
  const std::string line_end = '\n' + std::string(indent, ' ');
  std::string entry = "  " + name;
  if (is_below) {
    entry += line_end;
  } else {
    entry.resize(indent, ' ');
  }
  return entry + wrapped(text, columns - indent, line_end) + '\n';
}

void open_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1) continue;
    // For the other direction, and the lowest descriptor that is free: this one.
    open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
  }
}

bool standard_output_is_written() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  const int reason = errno;
  std::cout.flush();
  if (flushed && std::cout.good() && std::ferror(stdout) == 0) return true;
  // An earlier failure has left no reason.
  const std::string why = flushed ? "" : std::string(" (") + std::strerror(reason) + ")";
  complain("error: standard output is incomplete: it could not be written" + why);
  return false;
}

void complain(const std::string& text) {
  std::fputs((text + '\n').c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace touchstone
