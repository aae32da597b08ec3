#include "properties/pose_class.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <map>

#include "properties/named.hpp"

namespace touchstone {
namespace {

using Orientations = Arrangement::Orientations;

std::vector<Arrangement> make_arrangements(Pair pair) {
  std::vector<Arrangement> all = feature_arrangements(pair);
  for (Arrangement& a : lattice_arrangements(pair)) all.push_back(std::move(a));
  all.push_back(touching_tilted(pair));
  for (Arrangement& a : parallel_arrangements(pair)) all.push_back(std::move(a));
  if (pair == Pair::convex) {
    for (Arrangement& a : all) a.suite = 3;
  }
  if (auto recorded = recorded_arrangement(pair)) all.push_back(std::move(*recorded));
  all.push_back(hostile(pair));
  return all;
}

/// One of each pair, made when it is first asked for.
template <class Value, class Make>
std::array<Value, std::size(all_pairs)> of_each_pair(const Make& make) {
  std::array<Value, std::size(all_pairs)> result;
  for (const Pair pair : all_pairs) result[static_cast<std::size_t>(pair)] = make(pair);
  return result;
}

struct OldName {
  std::string name, today;
};

std::vector<OldName> make_old_names() {
  std::vector<OldName> names = {{"general-separated", "general+apart"},
                                {"general-shallow", "general+shallow"},
                                {"general-deep", "general+deep"},
                                {"touching-rounded", "general+touching"},
                                {"aspect-needle", "general+needle"},
                                {"aspect-coin", "general+coin"},
                                {"aspect-needle-deep", "general+deep+needle"},
                                {"aspect-coin-deep", "general+deep+coin"},
                                {"scale-tiny", "general+tiny"},
                                {"scale-huge", "general+huge"},
                                {"far-from-origin", "general+far"}};
  for (const Modifier& m : all_modifiers()) {
    if (m.kind != ModifierKind::tilt) continue;
    const std::string size = fmt::format("1e-{}", m.value);
    names.push_back({"near-parallel-" + size, "parallel+" + m.name});
    names.push_back({"near-perpendicular-" + size, "perpendicular+" + m.name});
  }
  return names;
}

const std::vector<OldName>& old_names() {
  static const std::vector<OldName> names = make_old_names();
  return names;
}

std::vector<PoseClass> make_old_classes(Pair pair) {
  std::vector<PoseClass> result;
  const auto add = [&](std::string_view name) { result.emplace_back(pair, name); };
  const auto& all = arrangements(pair);
  for (const char* name : {"general+apart", "general+shallow", "general+deep"}) add(name);
  const auto add_if = [&](const auto& condition) {
    for (const Arrangement& a : all) {
      if (condition(a)) add(a.name);
    }
  };
  const auto is_aligned = [](const Arrangement& a) {
    return a.name == "parallel" || a.name == "perpendicular";
  };
  const auto made_of_features = [&](const Arrangement& a) {
    return a.orientations == Orientations::random || a.orientations == Orientations::nearly;
  };
  add_if([&](const Arrangement& a) {
    return made_of_features(a) && a.name != "general" && !a.is_symmetric && !is_aligned(a);
  });
  add("general+touching");
  add_if([&](const Arrangement& a) { return made_of_features(a) && a.is_symmetric; });
  const auto came_with_modifiers = [](const Arrangement& a) {
    constexpr std::array names = {"perpendicular-t-centred", "perpendicular-x-centred",
                                  "cap-on-side-centred", "side-on-face-centred"};
    return std::find(names.begin(), names.end(), a.name) != names.end();
  };
  add_if([&](const Arrangement& a) {
    return a.is_exact() && a.suite == all.front().suite && !came_with_modifiers(a);
  });
  for (const Arrangement& a : all) {
    if (!is_aligned(a)) continue;
    for (const Modifier& m : all_modifiers()) {
      if (m.kind == ModifierKind::tilt) add(a.name + "+" + m.name);
    }
  }
  for (const char* name : {"general+needle", "general+coin", "general+deep+needle",
                           "general+deep+coin", "general+tiny", "general+huge", "general+far"}) {
    add(name);
  }
  return result;
}

std::string_view todays_name(std::string_view name) {
  for (const OldName& old : old_names()) {
    if (old.name == name) return old.today;
  }
  return name;
}

const Arrangement* find_arrangement(Pair pair, std::string_view name) {
  for (const Arrangement& a : arrangements(pair)) {
    if (a.name == name) return &a;
  }
  return nullptr;
}

/// Sets the modifier of that name, or says why it cannot be.
std::optional<std::string> set_modifier(PoseClass& c, std::string_view part) {
  std::vector<std::string> known;
  for (const Modifier& m : all_modifiers()) {
    known.push_back(m.name);
    if (m.name != part) continue;
    if (c.modifiers[m.kind] != 0) {
      const auto set = c.modifiers.list();
      const auto same_kind = [&](const Modifier* other) { return other->kind == m.kind; };
      const Modifier* other = *std::find_if(set.begin(), set.end(), same_kind);
      return fmt::format("must not have both {} and {}", other->name, m.name);
    }
    if (const auto why = nonsense(c.pair, *c.arrangement, m)) {
      return fmt::format("must not have {}: {}", m.name, *why);
    }
    c.modifiers[m.kind] = m.value;
    return std::nullopt;
  }
  return fmt::format("must have modifiers such as {}", nearest(part, known));
}

/// Why an arrangement cannot have a hull of that form.
std::optional<std::string_view> nonsense_of_hull(const Arrangement& a, HullForm form) {
  if (!a.is_exact() || form == HullForm::of_box) return std::nullopt;
  if (form != HullForm::triangle) return "its hull is a box with corners cut off, which is exact";
  if (a.own == Clearance::deep) return "nothing lies within a triangle";
  if (a.orientations == Orientations::pitched) return "it is about features that a box has";
  return std::nullopt;
}

}  // namespace

const std::vector<Arrangement>& arrangements(Pair pair) {
  static const auto all = of_each_pair<std::vector<Arrangement>>(make_arrangements);
  return all[static_cast<std::size_t>(pair)];
}

PoseClass::PoseClass(Pair of, std::string_view name) : PoseClass(of, nullptr, {}) {
  const auto parsed = parse_pose_class(of, name);
  if (const auto* why = std::get_if<std::string>(&parsed)) {
    throw InvalidInput("identity.class", in_quotes(name), *why);
  }
  *this = std::get<PoseClass>(parsed);
}

std::string PoseClass::name() const {
  std::string result = arrangement->name;
  for (const Modifier* m : modifiers.list()) result += "+" + m->name;
  return result;
}

std::string PoseClass::description() const {
  std::string result = arrangement->description;
  for (const Modifier* m : modifiers.list()) result += " " + m->description;
  return result;
}

Group PoseClass::group() const {
  const Orientations o = arrangement->orientations;
  const Clearance asked = modifiers.clearance();
  const Clearance clearance = asked == Clearance::usual ? arrangement->own : asked;
  if (o == Orientations::recorded) return Group::recorded;
  if (o == Orientations::given) return Group::given;
  if (o == Orientations::mixed || clearance == Clearance::deep ||
      modifiers.hull() == HullForm::wedge || modifiers[ModifierKind::proportions] != 0 ||
      modifiers[ModifierKind::scale] != 0 || modifiers[ModifierKind::distance] != 0) {
    return Group::extreme;
  }
  const bool is_turned = modifiers.frame() == Frame::turned || modifiers.frame() == Frame::worn;
  const bool exact = arrangement->is_exact() && !is_turned;
  if (exact || arrangement->is_symmetric || arrangement->touches ||
      clearance == Clearance::touching || modifiers[ModifierKind::tilt] != 0 ||
      modifiers.hull() == HullForm::nearly_coplanar) {
    return Group::degenerate;
  }
  return Group::everyday;
}

ClassParts PoseClass::parts() const {
  ClassParts result{arrangement->name, {}};
  for (const Modifier* m : modifiers.list()) result.modifiers.push_back(m->name);
  return result;
}

Configuration PoseClass::generate(Draw& draw) const {
  const Configuration made = arrangement->generate(draw, modifiers);
  return modified(draw, made, modifiers, {arrangement->is_exact(), arrangement->across});
}

std::optional<std::string_view> nonsense(Pair pair, const Arrangement& a, const Modifier& m) {
  if (a.orientations == Orientations::mixed) return "it has everything already";
  if (a.orientations == Orientations::recorded) return "it is as it occurred";
  switch (m.kind) {
    case ModifierKind::clearance:
      if (std::find(a.clearances.begin(), a.clearances.end(), static_cast<Clearance>(m.value)) !=
          a.clearances.end()) {
        return std::nullopt;
      }
      if (a.touches) return "its bodies touch already";
      if (a.is_symmetric) return "its centres or axes say how deep it is";
      if (static_cast<Clearance>(m.value) == a.own) return "it is so already";
      if (a.own == Clearance::deep) return "its bodies lie within each other";
      if (static_cast<Clearance>(m.value) == Clearance::touching) return "it cannot be exact";
      return "another feature than its own would be nearer, as in general+deep";
    case ModifierKind::proportions:
      if (static_cast<Proportions>(m.value) == Proportions::plate && !has_faces(pair)) {
        return "neither body is a box or a hull";
      }
      if (static_cast<Proportions>(m.value) == Proportions::uneven && pair == Pair::plane) {
        return "a plane has no size";
      }
      if (static_cast<Proportions>(m.value) == Proportions::needles && pair != Pair::capsule &&
          pair != Pair::cylinder) {
        return "the other body is no cylinder or capsule";
      }
      return std::nullopt;
    case ModifierKind::hull:
      if (pair != Pair::convex) return "neither body is a hull";
      return nonsense_of_hull(a, static_cast<HullForm>(m.value));
    case ModifierKind::tilt:
      if (a.orientations == Orientations::random) return "its axes are at a random angle already";
      if (a.orientations == Orientations::pitched) return "it is tilted already";
      return std::nullopt;
    case ModifierKind::frame:
      if (!a.is_exact()) return "its bodies are turned at random already";
      return std::nullopt;
    case ModifierKind::scale:
    case ModifierKind::unit:
    case ModifierKind::distance:
      break;
  }
  return std::nullopt;
}

bool has_arrangement(Pair pair, std::string_view pose_class) {
  return find_arrangement(pair, split(todays_name(pose_class), '+').front()) != nullptr;
}

std::string nearest_arrangements(const std::vector<Pair>& pairs, std::string_view name) {
  std::vector<std::string> known;
  for (const Pair pair : pairs) {
    for (const Arrangement& a : arrangements(pair)) {
      if (std::find(known.begin(), known.end(), a.name) == known.end()) known.push_back(a.name);
    }
  }
  for (const OldName& old : old_names()) known.push_back(old.name);
  return nearest(name, known);
}

std::variant<PoseClass, std::string> parse_pose_class(Pair pair, std::string_view name) {
  const auto because = [&](const std::string& why) {
    return fmt::format("{}; touchstone list classes {} has all", why, pair_name(pair));
  };
  const std::vector<std::string_view> parts = split(todays_name(name), '+');
  PoseClass result(pair, find_arrangement(pair, parts.front()), {});
  if (!result.arrangement) {
    return because(fmt::format("must begin with an arrangement of {}, as {}", pair_name(pair),
                               nearest_arrangements({pair}, parts.front())));
  }
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (const auto why = set_modifier(result, parts[i])) return because(*why);
  }
  return result;
}

PoseClass given_class(Pair pair) {
  static const Arrangement given{
      "given", "Configurations that came in a file.", Orientations::given, {}, {}};
  return {pair, &given, {}};
}

std::string stream_name(const PoseClass& pose_class) {
  static const std::map<std::string, std::string> old_of_today = [] {
    std::map<std::string, std::string> result;
    for (const OldName& old : old_names()) result[old.today] = old.name;
    return result;
  }();
  const std::string name = pose_class.name();
  const auto old = old_of_today.find(name);
  return old == old_of_today.end() ? name : old->second;
}

const std::vector<PoseClass>& old_classes(Pair pair) {
  static const auto all = of_each_pair<std::vector<PoseClass>>(make_old_classes);
  return all[static_cast<std::size_t>(pair)];
}

}  // namespace touchstone
