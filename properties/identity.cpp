#include "properties/identity.hpp"

#include <algorithm>
#include <array>
#include <charconv>

#include "properties/pose_class.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// FNV-1a, 64 bits: makes a part of the random key from a class name, on all platforms alike.
std::uint64_t stable_hash(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return hash;
}

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

template <class Range>
std::string joined(const Range& names) {
  std::string all;
  for (const auto& name : names) all += (all.empty() ? "" : ", ") + std::string(name);
  return all;
}

/// All classes of a pair, including those that run only when named.
std::vector<std::string> all_names(Pair pair) {
  std::vector<std::string> names;
  for (const PoseClass& c : pose_class_table(pair)) names.push_back(c.name);
  return names;
}

rc::Random stream_of(const Identity& identity) {
  const std::string name = std::string(pair_name(identity.pair)) + "/" + identity.pose_class;
  return rc::Random(rc::Random::Key{identity.seed, identity.index, stable_hash(name), 0});
}

}  // namespace

const std::vector<PoseClass>& pose_class_table(Pair pair) {
  static const auto tables = [] {
    std::array<std::vector<PoseClass>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) {
      auto& table = result[static_cast<std::size_t>(p)];
      for (auto part : {feature_classes(p), lattice_classes(p), touching_tilted_class(p),
                        limit_classes(p), hostile_class(p)}) {
        table.insert(table.end(), part.begin(), part.end());
      }
    }
    return result;
  }();
  return tables[static_cast<std::size_t>(pair)];
}

const PoseClass& find_pose_class(Pair pair, std::string_view name) {
  for (const PoseClass& c : pose_class_table(pair)) {
    if (c.name == name) return c;
  }
  throw InvalidInput(
      "identity.class", quoted(name),
      std::string("must be a pose class of ") + pair_name(pair) + ": " + joined(all_names(pair)));
}

Pair parse_pair(std::string_view name) {
  std::vector<std::string> names;
  for (const Pair pair : all_pairs) {
    if (name == pair_name(pair)) return pair;
    names.emplace_back(pair_name(pair));
  }
  throw InvalidInput("identity.pair", quoted(name), "must be one of " + joined(names));
}

std::string to_string(const Identity& identity) {
  return std::string(pair_name(identity.pair)) + "/" + identity.pose_class + "/" +
         std::to_string(identity.seed) + "/" + std::to_string(identity.index);
}

Identity parse_identity(std::string_view text) {
  std::array<std::string_view, 4> parts;
  std::string_view rest = text;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t slash = i < 3 ? rest.find('/') : rest.size();
    if (slash == std::string_view::npos) {
      throw InvalidInput("identity", quoted(text),
                         "must read pair/class/seed/index, as in "
                         "cylinder-box/near-parallel-1e-6/42/137");
    }
    parts[i] = rest.substr(0, slash);
    rest = i < 3 ? rest.substr(slash + 1) : rest;
  }
  const Pair pair = parse_pair(parts[0]);
  const PoseClass& pose_class = find_pose_class(pair, parts[1]);
  return {pair, pose_class.name, parse_number("identity.seed", parts[2]),
          parse_number("identity.index", parts[3])};
}

const std::vector<std::string>& pose_classes(Pair pair) {
  static const auto names = [] {
    std::array<std::vector<std::string>, std::size(all_pairs)> result;
    for (const Pair p : all_pairs) {
      for (const PoseClass& c : pose_class_table(p)) {
        if (!c.by_name_only) result[static_cast<std::size_t>(p)].push_back(c.name);
      }
    }
    return result;
  }();
  return names[static_cast<std::size_t>(pair)];
}

std::vector<std::string> pose_classes(Pair pair, const std::vector<std::string>& wanted) {
  if (wanted.empty()) return pose_classes(pair);
  std::vector<std::string> names = all_names(pair);
  std::erase_if(names, [&](const std::string& name) {
    return std::find(wanted.begin(), wanted.end(), name) == wanted.end();
  });
  return names;
}

void check_pose_classes(const std::vector<Pair>& pairs, const std::vector<std::string>& classes) {
  std::vector<std::string> known;  // in report order, each once
  for (const Pair pair : pairs) {
    for (const auto& name : all_names(pair)) {
      if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
    }
  }
  for (const auto& name : classes) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InvalidInput("--class", quoted(name), "must be one of " + joined(known));
  }
}

std::string_view describe_pose_class(Pair pair, std::string_view pose_class) {
  return find_pose_class(pair, pose_class).description;
}

Configuration make_configuration(const Identity& identity) {
  Draw draw(stream_of(identity));
  return find_pose_class(identity.pair, identity.pose_class).generate(draw);
}

Configuration make_configuration(const Identity& identity, std::vector<std::uint64_t>& tape) {
  Draw draw(stream_of(identity), tape);
  return find_pose_class(identity.pair, identity.pose_class).generate(draw);
}

std::uint64_t parse_number(const char* field, std::string_view text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw InvalidInput(field, quoted(text), "must be a whole number from 0 to 2^64 - 1");
  }
  return value;
}

Subject subject(const Identity& identity) {
  return {to_string(identity), std::string(describe_pose_class(identity.pair, identity.pose_class)),
          make_configuration(identity)};
}

}  // namespace touchstone
