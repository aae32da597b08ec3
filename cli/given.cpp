#include "cli/given.hpp"

#include <fmt/format.h>
#include <iostream>
#include <optional>
#include <sstream>
#include <utility>

#include "properties/files/configuration_json.hpp"
#include "properties/files/json_fields.hpp"
#include "properties/files/read_file.hpp"
#include "properties/files/strict_json.hpp"
#include "properties/identity.hpp"
#include "properties/motions/motion.hpp"
#include "properties/motions/perturbation.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

bool is_blank(const std::string& line) {
  return line.find_first_not_of(" \t\r") == std::string::npos;
}

/// The first of JSON Lines, all of which must be JSON. `whole` says why the text is not one value:
/// the error where not even its first line is.
json first_of_lines(const std::string& text, const InvalidInput& whole) {
  std::istringstream lines(text);
  std::string line;
  std::optional<json> first;
  for (std::size_t number = 1; std::getline(lines, line); ++number) {
    if (is_blank(line)) continue;
    try {
      json parsed = parse_json(line, fmt::format("line {}", number));
      if (!first) first = std::move(parsed);
    } catch (const InvalidInput&) {
      if (first) throw;
      throw whole;
    }
  }
  if (!first) throw whole;
  return *first;
}

json first_value(const std::string& text, const std::string& source) {
  try {
    return parse_json(text, source);
  } catch (const InvalidInput& e) {
    return first_of_lines(text, e);
  }
}

/// An identity, a name of the stability room, or either and a perturbation.
Subject named(const std::string& name) {
  constexpr std::size_t max_name = 1000;  // perturbations of perturbations stand one within another
  if (name.size() > max_name) {
    throw InvalidInput("input", '"' + name + '"',
                       "must be a file, or an identity, which is never that long");
  }
  if (const auto at = name.rfind('@'); at != std::string::npos) {
    const Perturbation perturbation = parse_perturbation(name.substr(at + 1));
    const Subject base = given_configuration(name.substr(0, at));
    return {name, base.description, perturbed(base.configuration, perturbation)};
  }
  if (const auto stability = named_configuration(name)) return *stability;
  return subject(parse_identity(name));
}

}  // namespace

Configuration configuration_from_text(const std::string& text, const std::string& source) {
  const json object = first_value(text, source);
  require_object(object, source);
  const bool wrapped = object.contains("configuration");
  return configuration_from_json(wrapped ? object["configuration"] : object).configuration;
}

Subject given_configuration(const std::string& input) {
  if (input == "-") {
    const std::string name = "standard input";
    return {name, "", configuration_from_text(read_stream(std::cin, name, "input"), name)};
  }
  if (!is_file(input)) return named(input);
  return {input, "", configuration_from_text(read_file(input, "input"), input)};
}

}  // namespace touchstone
