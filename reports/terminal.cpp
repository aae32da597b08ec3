#include "reports/terminal.hpp"

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace touchstone {
namespace {

constexpr std::size_t min_columns = 40, max_columns = 80;

/// Select graphic rendition, ECMA-48 8.3.117.
std::string rendered(const Terminal& terminal, const char* parameter, const std::string& text) {
  if (!terminal.has_colours) return text;
  return std::string("\x1b[") + parameter + 'm' + text + "\x1b[0m";
}

bool is_set(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value != '\0';
}

bool is_dumb() {
  const char* name = std::getenv("TERM");
  return !name || std::string_view(name) == "dumb";
}

}  // namespace

std::string Terminal::heading(const std::string& text) const { return rendered(*this, "1", text); }
std::string Terminal::good(const std::string& text) const { return rendered(*this, "32", text); }
std::string Terminal::bad(const std::string& text) const { return rendered(*this, "31", text); }

Terminal standard_output() {
  Terminal result;
  if (isatty(STDOUT_FILENO) == 0) return result;
  result.has_colours = !is_set("NO_COLOR") && !is_dumb();
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) {
    result.columns = std::clamp<std::size_t>(size.ws_col, min_columns, max_columns);
  }
  return result;
}

}  // namespace touchstone
