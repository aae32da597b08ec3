#include <fmt/format.h>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "candidates/candidates.hpp"
#include "candidates/npm_engines.hpp"
#include "cli/command.hpp"
#include "properties/laws/cast_laws.hpp"
#include "properties/laws/law.hpp"
#include "properties/pose_class.hpp"
#include "simulation/experiment.hpp"

namespace touchstone {
namespace {

// The manual page.

/// As it stands, whatever it starts with; quotes and hyphens as they are typed in a shell.
std::string literal(const std::string& text) {
  static const std::map<char, const char*> typed = {{'\\', "\\e"},  {'-', "\\-"},   {'\'', "\\(aq"},
                                                    {'`', "\\(ga"}, {'^', "\\(ha"}, {'~', "\\(ti"},
                                                    {'\n', "\n\\&"}};
  std::string result = text.starts_with('.') || text.starts_with('\'') ? "\\&" : "";
  for (const char c : text) {
    const auto at = typed.find(c);
    result += at == typed.end() ? std::string(1, c) : at->second;
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
    if (option->get_group().empty()) continue;  // hidden
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

/// Of a subcommand and of the program itself, whose options may stand after it too; not those that
/// --help hides.
std::vector<const CLI::Option*> named_options(const CLI::App& app) {
  std::vector<const CLI::Option*> options = options_of(app);
  std::erase_if(options,
                [](const CLI::Option* o) { return !o->nonpositional() || o->get_group().empty(); });
  return options;
}

using Words = std::set<std::string>;

Words candidate_names() {
  Words names;
  for (const Candidate* c : all_candidates()) names.insert(c->name);
  for (const NpmEngine& engine : npm_engines()) names.emplace(engine.family);
  return names;
}

Words arrangement_names() {
  Words names;
  for (const Pair pair : all_pairs) {
    for (const Arrangement& a : arrangements(pair)) names.insert(a.name);
  }
  return names;
}

/// What can be the value of an option that calls it so; nothing for files and numbers. Of pose
/// classes the arrangements, which any modifiers may follow.
Words words_for(const std::string& value) {
  Words words;
  if (value == "CANDIDATE") return candidate_names();
  if (value == "CLASS") return arrangement_names();
  if (value == "GROUP") return {"everyday", "degenerate", "extreme", "recorded"};
  if (value == "REPORT-PART")
    return {"scores", "timing", "casts", "stability", "experiments", "engines"};
  if (value == "ENGINE") return {"bullet", "bullet-float", "ode", "mujoco"};
  if (value == "PART") return {"amplification", "maps", "sequences"};
  if (value == "GOAL") return {"distance", "normal", "points", "hull", "time"};
  if (value == "LANGUAGE") return {"c++", "javascript", "python"};
  if (value == "FAILURE") return {"accuracy", "time"};
  if (value == "FORMAT") return {"jsonl", "csv", "npz"};
  if (value == "SHELL") return {"bash", "zsh"};
  if (value == "LIST") return {"candidates", "classes"};
  if (value == "PAIR") {
    for (const Pair pair : all_pairs) words.insert(pair_name(pair));
  } else if (value == "LAW") {
    for (const Law& law : all_laws()) words.insert(law.name);
    for (const CastLaw& law : all_cast_laws()) words.insert(law.name);
  } else if (value == "EXPERIMENT") {
    for (const Experiment& e : all_experiments()) words.insert(e.name);
  }
  return words;
}

/// "-h", "--help"
std::vector<std::string> spellings(const CLI::Option& option) {
  std::vector<std::string> result;
  for (const std::string& name : option.get_snames()) result.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) result.push_back("--" + name);
  return result;
}

std::string all_spellings(const CLI::App& app) {
  std::vector<std::string> all;
  for (const CLI::Option* option : named_options(app)) {
    for (const std::string& spelling : spellings(*option)) all.push_back(spelling);
  }
  return fmt::format("{}", fmt::join(all, " "));
}

/// For zsh, within single quotes and where brackets and colons mean something.
std::string zsh_quoted(const std::string& text) {
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

/// What zsh offers for a value: words, several of them separated by commas, or files.
std::string zsh_value(const std::string& name) {
  const Words words = words_for(name);
  if (words.empty()) return fmt::format(":{}:_files", zsh_quoted(name));
  return fmt::format(":{}:_sequence compadd - {}", zsh_quoted(name), fmt::join(words, " "));
}

/// `_arguments` of zsh: '--count[how many]:UINT:_files' for each spelling.
std::string zsh_options(const CLI::App& app) {
  std::string text;
  for (const CLI::Option* option : named_options(app)) {
    const bool takes_value = option->get_items_expected_max() > 0;
    const std::string value = takes_value ? zsh_value(option->get_type_name()) : "";
    for (const std::string& spelling : spellings(*option)) {
      text += fmt::format(" \\\n      '{}[{}]{}'", spelling, zsh_quoted(option->get_description()),
                          value);
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
  std::map<std::string, std::set<std::string>> spelt;  // of the options with a value of that name
  std::vector<const CLI::App*> apps = program.get_subcommands({});
  apps.push_back(&program);
  for (const CLI::App* app : apps) {
    for (const CLI::Option* option : named_options(*app)) {
      if (option->get_items_expected_max() > 0 && !words_for(option->get_type_name()).empty()) {
        for (const std::string& spelling : spellings(*option)) {
          spelt[option->get_type_name()].insert(spelling);
        }
      }
    }
  }
  std::string values;
  for (const auto& [value, options] : spelt) {
    values += fmt::format("    {}) values='{}' ;;\n", fmt::join(options, "|"),
                          fmt::join(words_for(value), " "));
  }
  std::string cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    cases += fmt::format("    {}) options='{}' ;;\n", command->get_name(), all_spellings(*command));
  }
  return fmt::format(R"(# bash completion of {0}; made by {0} --completion bash.
_{0}() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} command='' options values='' listed='' i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case ${{COMP_WORDS[i]}} in
      {1}) command=${{COMP_WORDS[i]}} && break ;;
    esac
  done
  case $command in
{2}    *) options='{3}' ;;
  esac
  case ${{COMP_WORDS[COMP_CWORD - 1]}} in
{5}  esac
  COMPREPLY=()
  if [[ -n $values ]]; then
    # Of a list with commas the last part is completed.
    [[ $word == *,* ]] && listed=${{word%,*}},
    mapfile -t COMPREPLY < <(compgen -P "$listed" -W "$values" -- "${{word##*,}}")
  elif [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  elif [[ -z $command && ${{COMP_WORDS[COMP_CWORD - 1]}} != -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W '{4}' -- "$word")
  fi
}}
complete -o default -F _{0} {0}
)",
                     program.get_name(), fmt::join(command_names(program), "|"), cases,
                     all_spellings(program), fmt::join(command_names(program), " "), values);
}

std::string zsh_completion(const CLI::App& program) {
  std::string commands, cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    commands +=
        fmt::format("    '{}:{}'\n", command->get_name(), zsh_quoted(command->get_description()));
    std::string positional = ":file:_files";
    for (const CLI::Option* option : command->get_options()) {
      if (!option->get_positional()) continue;
      positional = zsh_value(option->get_type_name());
      break;
    }
    cases += fmt::format("    {}) _arguments{} \\\n      '*{}' ;;\n", command->get_name(),
                         zsh_options(*command), positional);
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
