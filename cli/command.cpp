#include "cli/command.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <iostream>
#include <set>
#include <sstream>
#include <unistd.h>
#include <utility>

#include <CLI/CLI.hpp>

#include "candidates/readable.hpp"
#include "properties/named.hpp"
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
  std::string make_description(const CLI::App* app) const override {
    return Terminal{columns_}.folded(CLI::Formatter::make_description(app));
  }
  std::string make_usage(const CLI::App* app, std::string name) const override {
    return Terminal{columns_}.folded(CLI::Formatter::make_usage(app, std::move(name)));
  }
  /// Examples stay whole, to be pasted; lists are made for the terminal.
  std::string make_footer(const CLI::App* app) const override {
    std::istringstream lines(CLI::Formatter::make_footer(app));
    std::string result;
    for (std::string line; std::getline(lines, line);) {
      result += line.starts_with("  ") ? line + '\n' : Terminal{columns_}.folded(line + '\n');
    }
    return result;
  }
  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_name(),
                             wrapped(command->get_description(), columns_ - width_, "\n"), width_);
    return out.str();
  }
  /// What an option excludes stands in its description.
  std::string make_option_opts(const CLI::Option* option) const override {
    const std::string text = CLI::Formatter::make_option_opts(option);
    return text.substr(0, text.find(" Excludes:"));
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    std::set<std::string> excluded;
    for (const CLI::Option* other : option->get_excludes()) {
      if (!other->get_group().empty()) excluded.insert(other->get_name());  // none that is hidden
    }
    std::string text = CLI::Formatter::make_option_desc(option);
    if (!excluded.empty()) text += fmt::format("; not with {}", fmt::join(excluded, ", "));
    // CLI11 indents what follows a line's end.
    return wrapped(text, columns_ - width_, "\n");
  }

 private:
  std::size_t width_, columns_;
};

using Names = std::vector<std::string>;

/// "--count"; CLI11 has none for an option that it hides.
std::string name_of(const CLI::Option& option) {
  return option.get_lnames().empty() ? option.get_name() : "--" + option.get_lnames().front();
}

/// Subcommands of version 0.1.0 that are parts of others now.
constexpr std::pair<std::string_view, std::string_view> renamed[] = {
    {"candidates", "list candidates"}, {"certify", "replay --certify"},
    {"classes", "list classes"},       {"merge", "campaign --merge"},
    {"render", "simulate --povray"},   {"search", "check --search"}};

InvalidInput unknown_command(const CLI::App& program, const std::string& word) {
  std::string remedy = fmt::format("must be one of {}; {} --help says what they do",
                                   fmt::join(command_names(program), ", "), program.get_name());
  for (const auto& [old, now] : renamed) {
    if (word == old) remedy = fmt::format("{} is now `{} {}`", old, program.get_name(), now);
  }
  return {"subcommand", in_quotes(word), remedy};
}

/// CLI11 would only say that a subcommand is required.
void refuse_unknown_command(const CLI::App& program, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  const Names names = command_names(program);
  if (std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    throw unknown_command(program, argv[1]);
  }
}

/// What CLI11 met on the command line, as an error of ours: its own words name neither what was
/// given nor the remedy. `program` is as parsing left it.
class UsageError {
 public:
  explicit UsageError(const CLI::App& program) : program_(program), command_(&program) {
    if (!program.get_subcommands().empty()) command_ = program.get_subcommands().front();
    name_ =
        command_ == &program ? program.get_name() : program.get_name() + ' ' + command_->get_name();
  }

  InvalidInput of(const CLI::ParseError& error) const {
    const Names rest = program_.remaining(true);
    const auto option = std::find_if(rest.begin(), rest.end(),
                                     [](const std::string& word) { return word.starts_with('-'); });
    // What is missing may be what an unknown option has swallowed.
    if (option != rest.end()) return unknown_option(*option);
    if (!rest.empty() && command_ == &program_) return unknown_command(program_, rest.front());
    if (!rest.empty()) return not_expected(rest.front());
    if (dynamic_cast<const CLI::RequiredError*>(&error)) return missing();
    if (dynamic_cast<const CLI::ExcludesError*>(&error)) return excluded();
    return of_option(error);
  }

 private:
  InvalidInput unknown_option(const std::string& word) const {
    Names known;
    for (const CLI::Option* option : options_of(*command_)) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    return {"option", in_quotes(word),
            fmt::format("must be an option of {}, as {}; {} --help lists them", name_,
                        nearest(word.substr(0, word.find('=')), known), name_)};
  }

  InvalidInput not_expected(const std::string& word) const {
    Names taken;
    for (const CLI::Option* option : command_->get_options()) {
      if (option->get_positional()) taken.push_back(option->get_type_name());
    }
    const CLI::Option* const json = command_->get_option_no_throw("--json");
    if (json && json->count() > 0) {
      return {"argument", in_quotes(word),
              "must be left out; --json prints on standard output, which goes into a file by > " +
                  word};
    }
    for (const char* const option : {"--candidate", "--candidates"}) {
      if (!taken.empty() || command_->get_option_no_throw(option) == nullptr) continue;
      return {"argument", in_quotes(word),
              fmt::format("must follow an option, as {} {}", option, word)};
    }
    return {"argument", in_quotes(word),
            fmt::format("must be left out: {} takes {} and options", name_,
                        taken.empty() ? "no more than its name"
                                      : fmt::format("{}", fmt::join(taken, ", ")))};
  }

  InvalidInput missing() const {
    for (const CLI::Option* option : command_->get_options()) {
      if (!option->get_required() || option->count() > 0) continue;
      return {option->get_name(), "missing", "must be given: " + option->get_description()};
    }
    return {"subcommand", "missing",
            fmt::format("must be one of {}", fmt::join(command_names(program_), ", "))};
  }

  InvalidInput excluded() const {
    for (const CLI::Option* option : command_->get_options()) {
      if (option->count() == 0) continue;
      for (const CLI::Option* other : option->get_excludes()) {
        if (other->count() == 0) continue;
        return {name_of(*option), "given with " + name_of(*other), "must stand without it"};
      }
    }
    return {"command line", "contradictory", name_ + " --help says what goes together"};
  }

  /// CLI11's text has the option's name, "--count: 1 required UINT missing"; that of a flag without
  /// its dashes, "hostile was given a disallowed flag override".
  InvalidInput of_option(const CLI::ParseError& error) const {
    const std::string text = error.what();
    const std::string word = text.substr(0, text.find_first_of(": "));
    const std::string name = word.starts_with('-') ? word : "--" + word;
    for (const CLI::Option* option : options_of(*command_)) {
      if (name_of(*option) != name) continue;
      if (option->get_items_expected_max() == 0) {
        return {name, "given a value", "must stand alone"};
      }
      if (option->count() > 1) {
        return {name, fmt::format("given {} times", option->count()), "must be given once"};
      }
      return {name, "given no value",
              fmt::format("must be followed by {}: {}", option->get_type_name(),
                          option->get_description())};
    }
    return {"command line", in_quotes(text), "must be as " + name_ + " --help says"};
  }

  const CLI::App& program_;
  const CLI::App* command_;
  std::string name_;
};

}  // namespace

std::vector<std::string> command_names(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

std::vector<const CLI::Option*> options_of(const CLI::App& command) {
  std::vector<const CLI::Option*> options = command.get_options();
  const CLI::App* const program = command.get_parent();
  if (program) {
    for (const CLI::Option* option : program->get_options()) {
      if (option != program->get_help_ptr()) options.push_back(option);
    }
  }
  return options;
}

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
Option& Option::default_text(const std::string& text) {
  option_->default_str(text);
  return *this;
}
std::string Option::name() const { return name_of(*option_); }
bool Option::is_given() const { return option_->count() > 0; }

Option Command::text(const std::string& name, const std::string& value, std::string& variable,
                     const std::string& description) {
  // Empty means not given, and a shell's variable that is not set must not mean that.
  const auto read = [&variable, name](const std::string& text) {
    if (text.empty()) throw InvalidInput(name, in_quotes(text), "must be left out or have a value");
    variable = text;
  };
  CLI::Option* option =
      app_->add_option_function<std::string>(name, read, description)->type_name(value);
  if (!variable.empty()) option->default_str(variable);
  return Option(option);
}

Option Command::list(const std::string& name, const std::string& value,
                     std::vector<std::string>& variable, const std::string& description) {
  const Option option = arguments(name, value, variable, description);
  option.option_->delimiter(',')->allow_extra_args(false);
  return option;
}

Option Command::arguments(const std::string& name, const std::string& value,
                          std::vector<std::string>& variable, const std::string& description) {
  return Option(app_->add_option(name, variable, description)->type_name(value));
}

Option Command::flag(const std::string& name, bool& variable, const std::string& description) {
  return Option(app_->add_flag(name, variable, description)->disable_flag_override());
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

void Command::mode(const Option& option, const Names& own, const Names& common) {
  for (const std::string& name : own) {
    CLI::Option* const each = app_->get_option(name);
    if (!each->get_group().empty()) each->group("With " + option.name());
  }
  modes_.push_back({option.option_, own, common});
}

void Command::refuse_what_has_no_effect(const CLI::App& command, const std::vector<Mode>& modes) {
  const auto has = [](const Names& names, const CLI::Option* option) {
    return std::find(names.begin(), names.end(), name_of(*option)) != names.end();
  };
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0 || option->get_positional()) continue;
    Names owners;
    bool is_owned = false;
    for (const Mode& mode : modes) {
      const bool is_own = has(mode.own, option), is_on = mode.option->count() > 0;
      if (is_own) owners.push_back(name_of(*mode.option));
      is_owned = is_owned || (is_own && is_on);
      if (is_own || !is_on || option == mode.option || has(mode.common, option)) continue;
      throw InvalidInput(name_of(*option), "given with " + name_of(*mode.option),
                         "must stand without it");
    }
    if (owners.empty() || is_owned) continue;
    throw InvalidInput(name_of(*option), "given",
                       fmt::format("must stand beside {}", fmt::join(owners, " or ")));
  }
}

void Command::footer(const std::string& text) { app_->footer(text); }

void Command::runs(std::function<int()> action) {
  app_->callback([action = std::move(action), code = exit_code_, app = app_, modes = modes_] {
    refuse_what_has_no_effect(*app, modes);
    *code = action();
  });
}

Program::Program(const std::string& name, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, name)) {
  app_->add_flag_callback(
      "--manual",
      [this] {
        print(manual(*app_));
        throw CLI::Success();
      },
      "Print the manual page in troff, as for man -l -");
  const auto complete = [this](const std::string& shell) {
    if (shell != "bash" && shell != "zsh") {
      throw InvalidInput("--completion", '"' + shell + '"', "must be bash or zsh");
    }
    print(shell == "bash" ? bash_completion(*app_) : zsh_completion(*app_));
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
  } catch (const CLI::Success& e) {
    app_->exit(e);  // prints what --help and --version ask for
  } catch (const CLI::ParseError& e) {
    throw UsageError(*app_).of(e);
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

void write_then_print(const std::function<void()>& write, const std::string& text) {
  try {
    write();
  } catch (const InvalidInput&) {
    print(text);
    throw;
  }
  print(text);
}

void print(const std::string& text) { fmt::print("{}", escaped(text)); }

void complain(const std::string& text) {
  std::fputs((escaped(text) + '\n').c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace touchstone
