#include <algorithm>
#include <fmt/format.h>
#include <vector>

#include <CLI/CLI.hpp>

#include "cli/command.hpp"

namespace touchstone {
namespace {

// The manual page.

/// troff's name of the UTF-8 character that begins at `at`, which is left on its last byte.
std::string named_character(const std::string& text, std::size_t& at) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const int following = byte(at) >= 0xF0 ? 3 : byte(at) >= 0xE0 ? 2 : 1;
  unsigned code = byte(at) & (0x3FU >> following);
  for (int i = 0; i < following; ++i) code = code << 6 | (byte(++at) & 0x3FU);
  return fmt::format("\\[u{:04X}]", code);
}

/// As it stands, whatever it starts with; quotes and hyphens as they are typed in a shell.
std::string literal(const std::string& text) {
  std::string result = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (static_cast<unsigned char>(c) >= 0x80) {
      result += named_character(text, at);
      continue;
    }
    switch (c) {
      case '\\':
        result += "\\e";
        break;
      case '-':
        result += "\\-";
        break;
      case '\'':
        result += "\\(aq";
        break;
      case '`':
        result += "\\(ga";
        break;
      case '^':
        result += "\\(ha";
        break;
      case '~':
        result += "\\(ti";
        break;
      case '\n':
        result += "\n\\&";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string label(const CLI::Option& option) {
  std::string text = "\\fB" + literal(option.get_name(false, true)) + "\\fR";
  if (option.get_positional()) text = "\\fI" + literal(option.get_name()) + "\\fR";
  if (option.get_items_expected_max() > 0) {
    text += " \\fI" + literal(option.get_type_name()) + "\\fR";
  }
  return text;
}

std::string described(const CLI::Option& option) {
  std::string text = option.get_description();
  if (option.get_required()) text += " (required)";
  if (!option.get_default_str().empty()) text += fmt::format(" [{}]", option.get_default_str());
  return literal(text);
}

std::string options(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : app.get_options()) {
    text += fmt::format(".TP\n{}\n{}\n", label(*option), described(*option));
  }
  return text;
}

/// Examples and lists keep their lines.
std::string footer(const CLI::App& app) {
  return app.get_footer().empty() ? ""
                                  : fmt::format(".PP\n.nf\n{}\n.fi\n", literal(app.get_footer()));
}

// Completion.

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

std::string manual(const CLI::App& program) {
  const std::string& name = program.get_name();
  const std::string description = program.get_description();
  // "Touchstone: what it is.\nMore." is listed as "touchstone - what it is".
  const auto start = description.find(": ") + 2, end = description.find(".\n");
  std::string text = fmt::format(
      ".TH {0} 1 \"\" \"{0} {1}\" \"User commands\"\n"
      ".SH NAME\n{0} \\- {2}\n"
      ".SH SYNOPSIS\n\\fB{0}\\fR \\fIcommand\\fR [\\fIoptions\\fR]\n"
      ".SH DESCRIPTION\n{3}\n"
      ".SH OPTIONS\n{4}"
      ".SH COMMANDS\n",
      name, TOUCHSTONE_VERSION, literal(description.substr(start, end - start)),
      literal(description), options(program));
  for (const CLI::App* command : program.get_subcommands({})) {
    text += fmt::format(".SS \"{} {}\"\n{}\n{}{}", name, command->get_name(),
                        literal(command->get_description()), options(*command), footer(*command));
  }
  return text + ".SH EXAMPLES AND EXIT CODES\n" + footer(program);
}

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
