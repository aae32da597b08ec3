#include "properties/files/json_members.hpp"

namespace touchstone {

using nlohmann::json;

JsonIn JsonIn::at(const std::string& name) const {
  if (!value_.is_object()) refuse("must be an object");
  const std::string place = place_.empty() ? name : place_ + '.' + name;
  const auto member = value_.find(name);
  if (member == value_.end()) throw InvalidInput(place, "missing", "must be given");
  return JsonIn(*member, place);
}

void JsonIn::ascending(std::initializer_list<const char*> names) const {
  const char* before = nullptr;
  for (const char* const name : names) {
    if (!has(name)) continue;
    if (before && value_[name] < value_[before]) {
      at(name).refuse(
          fmt::format("must not be less than its {}, {}", before, shown(value_[before])));
    }
    before = name;
  }
}

void JsonIn::refuse(const std::string& must) const {
  throw InvalidInput(place_, shown(value_), must);
}

double JsonIn::number(const Rule& rule) const {
  if (rule.or_null && value_.is_null()) return std::numeric_limits<double>::quiet_NaN();
  if (!value_.is_number() || !rule.allows(value_.get<double>())) {
    refuse(rule.must ? rule.must : "must be a number");
  }
  return value_.get<double>();
}

}  // namespace touchstone
