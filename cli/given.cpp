#include "cli/given.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"
#include "reports/configuration_json.hpp"
#include "stability/name.hpp"
#include "stability/perturbation.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// All of the text, or its first line that is not blank.
json first_object(const std::string& text) {
  json whole = json::parse(text, nullptr, false);
  if (whole.is_object()) return whole;
  const auto start = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  const std::string line = text.substr(start, text.find('\n', start) - start);
  json object = json::parse(line, nullptr, false);
  if (object.is_object()) return object;
  throw InvalidInput("line", '"' + line.substr(0, 60) + '"', "must be a JSON object");
}

Configuration read_configuration(std::istream& in) {
  const json object = first_object({std::istreambuf_iterator<char>(in), {}});
  const bool wrapped = object.contains("configuration");
  return configuration_from_json(wrapped ? object["configuration"] : object).configuration;
}

/// An identity, a name of the stability room, or either and a perturbation.
Subject named(const std::string& name) {
  if (const auto at = name.rfind('@'); at != std::string::npos) {
    const Perturbation perturbation = parse_perturbation(name.substr(at + 1));
    const Subject base = given_configuration(name.substr(0, at));
    return {name, base.description, perturbed(base.configuration, perturbation)};
  }
  if (const auto stability = named_configuration(name)) return *stability;
  return subject(parse_identity(name));
}

}  // namespace

Subject given_configuration(const std::string& input) {
  if (input == "-") return {"standard input", "", read_configuration(std::cin)};
  if (!std::filesystem::is_regular_file(input)) return named(input);
  std::ifstream file(input);
  if (!file) throw InvalidInput("input", '"' + input + '"', "could not be opened for reading");
  return {input, "", read_configuration(file)};
}

}  // namespace touchstone
