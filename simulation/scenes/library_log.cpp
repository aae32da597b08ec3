#include "simulation/scenes/library_log.hpp"

#include <algorithm>
#include <sstream>
#include <unistd.h>

#include "properties/files/given_text.hpp"

namespace touchstone {
namespace {

std::string text_of(int log) {
  constexpr std::size_t max_text = 1 << 16;
  std::string text(max_text, '\0');
  const ssize_t size = pread(log, text.data(), text.size(), 0);
  text.resize(static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
  return text;
}

/// Without the colours of a terminal: "\x1b[1;31mError" is "Error".
std::string uncoloured(std::string text) {
  for (std::size_t at = text.find("\x1b["); at != text.npos; at = text.find("\x1b[", at)) {
    text.erase(at, text.find('m', at) - at + 1);
  }
  return text;
}

}  // namespace

std::string complaint_in(int log) {
  std::istringstream lines(uncoloured(text_of(log)));
  std::string chosen;
  for (std::string line; std::getline(lines, line);) {
    const bool is_error = line.starts_with("Error");
    if (chosen.empty() || is_error) chosen = line;
    if (is_error) break;
  }
  if (chosen.starts_with("Error")) {
    // "Error [parser.cc:123] what", "Error:   what", and with "Error Code 17: Msg: what" after it.
    const std::size_t bracket = chosen.starts_with("Error [") ? chosen.find(']') : chosen.find(':');
    if (bracket != chosen.npos) chosen.erase(0, bracket + 1);
    if (const std::size_t message = chosen.find("Msg: "); message != chosen.npos) {
      chosen.erase(0, message + 5);
    }
  }
  chosen.erase(0, chosen.find_first_not_of(" \t"));
  constexpr std::size_t max_shown = 300;
  return printable(chosen, max_shown);
}

}  // namespace touchstone
