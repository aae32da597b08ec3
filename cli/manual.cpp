#include "cli/manual.hpp"

#include <fmt/format.h>

namespace touchstone {
namespace {

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

}  // namespace

std::string manual(const CLI::App& program) {
  const std::string name = program.get_name();
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

}  // namespace touchstone
