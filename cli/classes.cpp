#include <algorithm>
#include <fmt/format.h>
#include <memory>

#include "cli/command.hpp"
#include "properties/pose_class.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr std::size_t name_width = 24;

/// Modifiers that some arrangement of these pairs can have; of the tilts the first, for all.
std::string modifier_list(const std::vector<Pair>& pairs) {
  std::string text;
  bool has_tilt = false;
  for (const Modifier& m : all_modifiers()) {
    const auto fits = [&](Pair pair) {
      const auto& all = arrangements(pair);
      return std::any_of(all.begin(), all.end(),
                         [&](const Arrangement& a) { return !nonsense(pair, a, m); });
    };
    if (std::none_of(pairs.begin(), pairs.end(), fits)) continue;
    if (m.kind != Kind::tilt) {
      text += list_entry(m.name, name_width, m.description);
    } else if (!has_tilt) {
      has_tilt = true;
      text += list_entry("tilted-1e-K", name_width,
                         "A is tilted by 1e-1 to 1e-15 rad about its centre.");
    }
  }
  return text;
}

std::string arrangement_list(Pair pair) {
  std::string text = fmt::format("Arrangements of {}:\n", pair_name(pair));
  for (const Arrangement& a : arrangements(pair)) {
    text += list_entry(a.name, name_width, a.description);
  }
  return text;
}

std::string group_list() {
  return "Groups:\n" +
         list_entry("everyday", name_width,
                    "Sizes within 1:20, turned at random, shallow, resting or apart: what scenes "
                    "produce.") +
         list_entry("degenerate", name_width,
                    "Exact, nearly exact (tilted, touching) or symmetric.") +
         list_entry("extreme", name_width,
                    "Needles, coins, plates, uneven sizes, tiny, huge, far away, or deep.") +
         list_entry("recorded", name_width,
                    "As it occurred in the scenes that come with Touchstone.");
}

int run(const std::string& pair) {
  std::vector<Pair> pairs(std::begin(all_pairs), std::end(all_pairs));
  if (!pair.empty()) {
    try {
      pairs = {parse_pair(pair)};
    } catch (const InvalidInput& e) {
      throw InvalidInput("pair", e.value(), e.remedy());
    }
  }
  for (const Pair each : pairs) fmt::print("{}\n", arrangement_list(each));
  fmt::print("Modifiers, any number of them in any order, as in parallel-side+turned:\n{}\n{}",
             modifier_list(pairs), group_list());
  for (const Pair each : pairs) {
    fmt::print("A report scores {} classes of {}, a campaign {}.\n", pose_classes(each).size(),
               pair_name(each), pose_classes(each, Coverage::triples).size());
  }
  return 0;
}

}  // namespace

void add_classes(Program& program) {
  Command command = program.command("classes", "List the pose classes: arrangements and modifiers");
  const auto pair = std::make_shared<std::string>();
  command.text("pair", *pair, "Only of this pair, as cylinder-box").value("PAIR");
  command.footer(
      "Examples:\n"
      "  touchstone classes\n"
      "  touchstone classes cylinder-box\n"
      "  touchstone report --class side-on-face,side-on-face+turned --pair cylinder-box");
  command.runs([pair] { return run(*pair); });
}

}  // namespace touchstone
