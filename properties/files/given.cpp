#include "properties/files/given.hpp"

#include <iostream>

#include "properties/files/configuration_json.hpp"
#include "properties/files/disk.hpp"
#include "properties/identity.hpp"
#include "properties/motions/motion.hpp"
#include "properties/motions/perturbation.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

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

Subject given_configuration(const std::string& input) {
  if (input == "-") {
    const std::string name = "standard input";
    return {name, "", configuration_from_text(read_stream(std::cin, name, "input"), name)};
  }
  if (!is_file(input)) return named(input);
  return {input, "", configuration_from_text(read_file(input, "input"), input)};
}

}  // namespace touchstone
