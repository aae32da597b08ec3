#include <nlohmann/json.hpp>

#include "properties/files/json_members.hpp"
#include "simulation/engines/run_engines.hpp"
#include "simulation/run_experiments.hpp"

namespace touchstone {

using nlohmann::json;

const char* name_of(ExperimentResult::Outcome outcome) {
  constexpr const char* names[] = {"measured", "unsupported", "unsound", "crashed", "timed-out"};
  return names[static_cast<int>(outcome)];
}

json to_json(const ExperimentResult& r) { return object_of(r); }
json to_json(const ExperimentDescription& e) { return object_of(e); }
json to_json(const ExperimentResults& r) { return object_of(r); }
json to_json(const EngineResults& r) { return object_of(r); }

}  // namespace touchstone
