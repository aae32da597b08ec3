#include "simulation/experiment.hpp"

#include "properties/named.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {

const std::vector<Experiment>& all_experiments() {
  static const std::vector<Experiment> experiments = [] {
    std::vector<Experiment> all;
    for (auto part : {resting_experiments(), moving_experiments(), threshold_experiments()}) {
      for (Experiment& e : part) all.push_back(std::move(e));
    }
    return all;
  }();
  return experiments;
}

const Experiment& find_experiment(const std::string& name) {
  return named(all_experiments(), name, "experiment");
}

}  // namespace touchstone
