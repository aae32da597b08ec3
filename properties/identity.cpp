#include "properties/identity.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <variant>

#include "properties/named.hpp"
#include "properties/pose_class.hpp"
#include "properties/stable_hash.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

Draw draw_of(const Identity& identity, Tape* tape) {
  const PoseClass& c = identity.pose_class;
  const std::string name = std::string(pair_name(c.pair)) + "/" + stream_name(c);
  const rc::Random random(rc::Random::Key{identity.seed, identity.index, stable_hash(name), 0});
  return tape ? Draw(random, *tape) : Draw(random);
}

Configuration made(const Identity& identity, Tape* tape) {
  Draw draw = draw_of(identity, tape);
  return identity.pose_class.generate(draw);
}

}  // namespace

Pair parse_pair(std::string_view name, const char* field) {
  return named(all_pairs, name, field, pair_name);
}

std::string to_string(const Identity& identity) {
  const PoseClass& c = identity.pose_class;
  return std::string(pair_name(c.pair)) + "/" + c.name() + "/" + std::to_string(identity.seed) +
         "/" + std::to_string(identity.index);
}

Identity parse_identity(std::string_view text) {
  std::array<std::string_view, 4> parts;
  std::string_view rest = text;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t slash = i < 3 ? rest.find('/') : rest.size();
    if (slash == std::string_view::npos) {
      throw InvalidInput("identity", in_quotes(text),
                         "must read pair/class/seed/index, as in "
                         "cylinder-box/side-on-face+turned/42/137");
    }
    parts[i] = rest.substr(0, slash);
    rest = i < 3 ? rest.substr(slash + 1) : rest;
  }
  const Pair pair = parse_pair(parts[0]);
  const PoseClass pose_class(pair, parts[1]);
  return {pose_class, parse_number("identity.seed", parts[2]),
          parse_number("identity.index", parts[3])};
}

const char* group_name(Group group) {
  constexpr std::array names = {"everyday", "degenerate", "extreme", "recorded", "given"};
  return names[static_cast<std::size_t>(group)];
}

Group parse_group(std::string_view name, const char* field) {
  return named(all_groups, name, field, group_name);
}

namespace {

/// Made when it is first asked for.
template <Coverage coverage>
const std::vector<std::string>& names_covering(Pair pair) {
  static const auto all = [] {
    std::array<std::vector<std::string>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) {
      for (const PoseClass& c : covering_classes(p, coverage)) {
        result[static_cast<std::size_t>(p)].push_back(c.name());
      }
    }
    return result;
  }();
  return all[static_cast<std::size_t>(pair)];
}

}  // namespace

const std::vector<std::string>& pose_classes(Pair pair, Coverage coverage) {
  if (coverage == Coverage::suite_1) return names_covering<Coverage::suite_1>(pair);
  if (coverage == Coverage::triples) return names_covering<Coverage::triples>(pair);
  return names_covering<Coverage::pairs>(pair);
}

std::optional<PoseClass> find_pose_class(Pair pair, std::string_view name) {
  const auto parsed = parse_pose_class(pair, name);
  const auto* found = std::get_if<PoseClass>(&parsed);
  return found ? std::optional(*found) : std::nullopt;
}

std::optional<PoseClass> find_pose_class(std::string_view pair, std::string_view name) {
  for (const Pair each : all_pairs) {
    if (pair == pair_name(each)) {
      const PoseClass given = given_class(each);
      return name == given.name() ? given : find_pose_class(each, name);
    }
  }
  return std::nullopt;
}

std::vector<PoseClass> selected(Pair pair, const ClassSelection& selection) {
  std::vector<PoseClass> result;
  if (selection.names.empty()) result = covering_classes(pair, selection.coverage);
  for (const std::string& name : selection.names) {
    const auto c = find_pose_class(pair, name);
    if (c && std::find(result.begin(), result.end(), *c) == result.end()) result.push_back(*c);
  }
  const std::vector<Group>& groups = selection.groups;
  std::erase_if(result, [&](const PoseClass& c) {
    return !groups.empty() && std::find(groups.begin(), groups.end(), c.group()) == groups.end();
  });
  return result;
}

std::vector<std::string> selected_classes(Pair pair, const ClassSelection& selection) {
  std::vector<std::string> names;
  for (const PoseClass& c : selected(pair, selection)) names.push_back(c.name());
  return names;
}

void check_pose_classes(const std::vector<Pair>& pairs, const std::vector<std::string>& classes) {
  for (const auto& name : classes) {
    const auto has = [&](Pair pair) { return find_pose_class(pair, name).has_value(); };
    if (std::any_of(pairs.begin(), pairs.end(), has)) continue;
    const auto begins = std::find_if(pairs.begin(), pairs.end(),
                                     [&](Pair pair) { return has_arrangement(pair, name); });
    if (begins == pairs.end()) {
      throw InvalidInput("--class", in_quotes(name),
                         "must begin with an arrangement, as " +
                             nearest_arrangements(pairs, name.substr(0, name.find('+'))) +
                             "; touchstone list classes has all");
    }
    // What is wrong with its modifiers.
    throw InvalidInput("--class", in_quotes(name),
                       std::get<std::string>(parse_pose_class(*begins, name)));
  }
}

void check_groups(const std::vector<Pair>& pairs, const ClassSelection& selection) {
  std::vector<Group> of_classes;
  for (const Pair pair : pairs) {
    if (!selected(pair, selection).empty()) return;
    for (const PoseClass& c : selected(pair, {selection.names, {}, selection.coverage})) {
      const Group group = c.group();
      if (std::find(of_classes.begin(), of_classes.end(), group) == of_classes.end()) {
        of_classes.push_back(group);
      }
    }
  }
  const auto names = [](const std::vector<Group>& groups) {
    std::string all;
    for (const Group group : groups)
      all += (all.empty() ? "" : ", ") + std::string(group_name(group));
    return all;
  };
  if (of_classes.empty()) return;  // no class of that name: check_pose_classes says what is near
  throw InvalidInput("--group", in_quotes(names(selection.groups)),
                     "must be of these pose classes, which are " + names(of_classes));
}

ClassParts parts_of(Pair pair, std::string_view pose_class) {
  return PoseClass(pair, pose_class).parts();
}

Configuration make_configuration(const Identity& identity) { return made(identity, nullptr); }

Configuration make_configuration(const Identity& identity, std::vector<std::uint64_t>& tape) {
  return made(identity, &tape);
}

std::uint64_t parse_number(const char* field, std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InvalidInput(field, in_quotes(text), "must be a whole number from 0 to 2^64 - 1");
  }
  return value;
}

Subject subject(const Identity& identity) {
  return {to_string(identity), identity.pose_class.description(), make_configuration(identity)};
}

}  // namespace touchstone
