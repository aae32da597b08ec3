#include "cli/completion.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace touchstone {
namespace {

using Options = std::vector<const CLI::Option*>;

/// Of a subcommand and of the program itself, whose options may stand after it too.
Options named_options(const CLI::App& app) {
  const auto named = [](const CLI::Option* o) { return o->nonpositional(); };
  Options options = app.get_options(named);
  const CLI::App* const parent = app.get_parent();
  for (const CLI::Option* option : parent ? parent->get_options(named) : Options()) {
    const bool is_known = std::any_of(options.begin(), options.end(), [&](const auto* o) {
      return o->get_name() == option->get_name();
    });
    if (!is_known) options.push_back(option);
  }
  return options;
}

/// "-h --help" of "-h,--help".
std::string spellings(const CLI::Option& option) {
  std::string text = option.get_name(false, true);
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

std::string all_spellings(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : named_options(app)) {
    text += (text.empty() ? "" : " ") + spellings(*option);
  }
  return text;
}

std::string command_names(const CLI::App& program, const char* separator) {
  std::string text;
  for (const CLI::App* command : program.get_subcommands({})) {
    text += (text.empty() ? "" : separator) + command->get_name();
  }
  return text;
}

/// For zsh, within single quotes and where brackets and colons mean something.
std::string quoted(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else if (c == '[' || c == ']' || c == ':' || c == '\\') {
      result += {'\\', c};
    } else {
      result += c == '\n' ? ' ' : c;
    }
  }
  return result;
}

/// `_arguments` of zsh: '--count[how many]:UINT:_files' for each spelling.
std::string zsh_options(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : named_options(app)) {
    const bool takes_value = option->get_items_expected_max() > 0;
    const std::string value =
        takes_value ? fmt::format(":{}:_files", quoted(option->get_type_name())) : "";
    std::string spelling;
    for (const char c : spellings(*option) + ' ') {
      if (c != ' ') {
        spelling += c;
        continue;
      }
      text +=
          fmt::format(" \\\n      '{}[{}]{}'", spelling, quoted(option->get_description()), value);
      spelling.clear();
    }
  }
  return text;
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    cases += fmt::format("    {}) options='{}' ;;\n", command->get_name(), all_spellings(*command));
  }
  return fmt::format(R"(# bash completion of {0}; made by {0} --completion bash.
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} command='' options i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
      {1}) command=${{COMP_WORDS[i]}} && break ;;
    esac
  done
  case $command in
{2}    *) options='{3}' ;;
  esac
  COMPREPLY=()
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  elif [[ -z $command && ${{COMP_WORDS[COMP_CWORD - 1]}} != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W '{4}' -- "$word")
  fi
}}
complete -o default -F _{0} {0}
)",
                     program.get_name(), command_names(program, "|"), cases, all_spellings(program),
                     command_names(program, " "));
}

std::string zsh_completion(const CLI::App& program) {
  std::string commands, cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands +=
        fmt::format("    '{}:{}'\n", command->get_name(), quoted(command->get_description()));
    cases += fmt::format("    {}) _arguments{} \\\n      '*:file:_files' ;;\n", command->get_name(),
                         zsh_options(*command));
  }
  return fmt::format(R"(#compdef {0}
# zsh completion of {0}; made by {0} --completion zsh.
_{0}() {{
  local state line
  local -a commands=(
{1}  )
  _arguments -C{2} \
    '1:command:->command' '*::argument:->argument'
  [[ $state == command ]] && _describe command commands
  [[ $state == argument ]] || return
  case $words[1] in
{3}  esac
}}
_{0} "$@"
)",
                     program.get_name(), commands, zsh_options(program), cases);
}

}  // namespace touchstone
