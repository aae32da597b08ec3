#include "simulation/scenes/need_json.hpp"

#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <map>

#include "properties/files/json_fields.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// One need's object.
class Fields {
 public:
  Fields(const json& value, std::string path, const Scene& scene)
      : value_(value), path_(std::move(path)), scene_(scene) {}

  void known(std::initializer_list<const char*> names) const {
    refuse_others(value_, names, path_);
  }
  bool has(const char* name) const { return value_.contains(name); }

  /// Finite and not negative.
  double size(const char* name) const {
    const json& given = member(value_, name, path_);
    const double x = number(given, at(name));
    if (!(std::isfinite(x) && x >= 0)) {
      throw InvalidInput(at(name), shown(given), "must be finite and not negative");
    }
    return x;
  }
  double size(const char* name, double otherwise) const {
    return has(name) ? size(name) : otherwise;
  }
  double positive(const char* name) const {
    const double x = size(name);
    if (x == 0) throw InvalidInput(at(name), "0", "must be positive");
    return x;
  }
  /// Within the scene's duration.
  double time(const char* name, double otherwise) const {
    const double t = size(name, otherwise);
    if (t > scene_.duration) {
      throw InvalidInput(at(name), shown(value_[name]), "must lie within the scene's duration");
    }
    return t;
  }
  double until() const { return time("until", scene_.duration); }
  Vec3 point(const char* name) const { return vector(member(value_, name, path_), at(name)); }

  int body(const char* name) const { return body(member(value_, name, path_), at(name)); }
  std::vector<int> bodies(std::size_t least, std::size_t most) const {
    const json& array = member(value_, "bodies", path_);
    if (!array.is_array() || array.size() < least || array.size() > most) {
      throw InvalidInput(at("bodies"), shown(array),
                         least == most ? "must be an array of two names of bodies"
                                       : fmt::format("must be an array of at least {} names of "
                                                     "bodies",
                                                     least));
    }
    std::vector<int> result;
    for (std::size_t i = 0; i < array.size(); ++i) {
      result.push_back(body(array[i], fmt::format("{}[{}]", at("bodies"), i)));
    }
    return result;
  }
  /// Two, of which one is a cylinder: only of such pairs contacts are looked at.
  std::vector<int> pair() const {
    const auto two = bodies(2, 2);
    for (const int b : two) {
      if (std::holds_alternative<Cylinder>(scene_.bodies[b].shape)) return two;
    }
    throw InvalidInput(at("bodies"), shown(value_["bodies"]), "one of them must be a cylinder");
  }
  /// All that can move, if none are named.
  std::vector<int> moving_bodies() const {
    if (has("bodies")) return bodies(1, scene_.bodies.size());
    std::vector<int> result;
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (!scene_.bodies[i].fixed) result.push_back(static_cast<int>(i));
    }
    return result;
  }
  void require_vertical() const {
    if (scene_.gravity.norm() == 0) {
      throw InvalidInput(path_ + ".need", shown(value_["need"]),
                         "has no meaning in a scene without gravity");
    }
  }
  std::string at(const char* name) const { return path_ + '.' + name; }

 private:
  int body(const json& name, const std::string& field) const {
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
      if (name == scene_.bodies[i].name) return static_cast<int>(i);
    }
    throw InvalidInput(field, shown(name), "must be the name of one of the bodies");
  }

  const json& value_;
  std::string path_;
  const Scene& scene_;
};

constexpr std::size_t any_number = 1000000;

using Read = std::function<Need(const Fields&)>;

const std::map<std::string, Read>& readers() {
  static const std::map<std::string, Read> all = {
      {"stands",
       [](const Fields& f) -> Need {
         f.known({"need", "body", "degrees", "from", "until"});
         f.require_vertical();
         return Stands{f.body("body"), f.size("degrees"), f.time("from", 0), f.until()};
       }},
      {"rolls",
       [](const Fields& f) -> Need {
         f.known({"need", "body", "distance", "share"});
         f.require_vertical();
         const auto distance =
             f.has("distance") ? std::optional(f.positive("distance")) : std::nullopt;
         return Rolls{f.body("body"), distance, f.size("share")};
       }},
      {"rests",
       [](const Fields& f) -> Need {
         f.known({"need", "bodies", "speed", "by"});
         return Rests{f.moving_bodies(), f.size("speed"), f.time("by", 0)};
       }},
      {"falls-in-order",
       [](const Fields& f) -> Need {
         f.known({"need", "bodies", "degrees"});
         return FallsInOrder{f.bodies(1, any_number), f.size("degrees", 45)};
       }},
      {"penetration",
       [](const Fields& f) -> Need {
         f.known({"need", "bodies", "metres", "from"});
         return Penetration{f.has("bodies") ? f.pair() : std::vector<int>(), f.size("metres"),
                            f.time("from", 0)};
       }},
      {"normals",
       [](const Fields& f) -> Need {
         f.known({"need", "bodies", "degrees"});
         return Normals{f.pair(), f.size("degrees")};
       }},
      {"ends-near",
       [](const Fields& f) -> Need {
         f.known({"need", "body", "metres"});
         return EndsNear{f.body("body"), f.size("metres")};
       }},
      {"ends-tilted",
       [](const Fields& f) -> Need {
         f.known({"need", "body", "degrees"});
         return EndsTilted{f.body("body"), f.size("degrees")};
       }},
      {"stays-in", [](const Fields& f) -> Need {
         f.known({"need", "body", "lower", "upper", "metres", "from"});
         const StaysIn need{f.body("body"), f.point("lower"), f.point("upper"), f.size("metres", 0),
                            f.time("from", 0)};
         if (!(need.lower.array() <= need.upper.array()).all()) {
           throw InvalidInput(f.at("upper"), "below lower", "must not lie below lower");
         }
         return need;
       }}};
  return all;
}

}  // namespace

Need need_from_json(const json& value, const std::string& path, const Scene& scene) {
  require_object(value, path);
  const json& kind = member(value, "need", path);
  const auto& all = readers();
  const auto found = kind.is_string() ? all.find(kind.get<std::string>()) : all.end();
  if (found == all.end()) {
    std::string names;
    for (const auto& [name, read] : all) names += (names.empty() ? "" : ", ") + name;
    throw InvalidInput(path + ".need", shown(kind), "must be one of " + names);
  }
  return found->second(Fields(value, path, scene));
}

}  // namespace touchstone
