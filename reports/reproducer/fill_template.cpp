#include "reports/reproducer/fill_template.hpp"

#include <algorithm>

namespace touchstone {
namespace {

/// Does one of the names in a list with commas stand among the tags?
bool names_one(std::string_view list, const Tags& tags) {
  const Tags names = names_in(list);
  return std::find_first_of(names.begin(), names.end(), tags.begin(), tags.end()) != names.end();
}

/// The lines for these tags, without the brackets.
std::string lines_for(const Tags& tags, std::string_view source) {
  std::string result;
  while (!source.empty()) {
    const auto end = std::min(source.find('\n'), source.size() - 1) + 1;
    std::string_view line = source.substr(0, end);
    source.remove_prefix(end);
    bool applies = true;
    while (applies && line.starts_with('[')) {
      const auto close = line.find(']');
      applies = names_one(line.substr(1, close - 1), tags);
      line.remove_prefix(close + (line[close + 1] == ' ' ? 2 : 1));
    }
    if (applies) result += line;
  }
  return result;
}

}  // namespace

Tags names_in(std::string_view list) {
  Tags names;
  while (!list.empty()) {
    const auto comma = list.find(',');
    names.push_back(list.substr(0, comma));
    list = comma == list.npos ? "" : list.substr(comma + 1);
  }
  return names;
}

std::string_view section(std::string_view source, std::string_view name) {
  const std::string heading = "=== " + std::string(name) + '\n';
  source.remove_prefix(source.find(heading) + heading.size());
  return source.substr(0, source.find("\n=== "));
}

std::string fill_template(std::string_view source, const Tags& tags, const Texts& texts) {
  const std::string lines = lines_for(tags, source);
  std::string result;
  for (std::string_view rest = lines;;) {
    const auto at = rest.find('@');
    result += rest.substr(0, at);
    if (at == rest.npos) break;
    const auto end = rest.find('@', at + 1);
    result += texts.at(std::string(rest.substr(at + 1, end - at - 1)));
    rest.remove_prefix(end + 1);
  }
  return result.substr(0, result.find_last_not_of('\n') + 1);
}

}  // namespace touchstone
