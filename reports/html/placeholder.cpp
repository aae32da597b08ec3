#include "reports/html/placeholder.hpp"

namespace touchstone {

void fill(std::string& page, std::string_view placeholder, std::string_view text) {
  page.replace(page.find(placeholder), placeholder.size(), text);
}

std::string script_safe(const nlohmann::json& json) {
  // "<" only occurs in strings, where \u003c says the same.
  std::string text;
  for (const char c : json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace touchstone
