#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>

#include "candidates/candidates.hpp"
#include "candidates/npm_engines.hpp"
#include "cli/command.hpp"
#include "properties/casts.hpp"
#include "properties/pose_class.hpp"
#include "reference/invalid_input.hpp"
#include "reports/terminal.hpp"

namespace touchstone {
namespace {

/// The shapes that it has a routine for, against a cylinder.
std::string other_shapes(const Candidate& candidate) {
  constexpr std::string_view before = "cylinder-";  // of a pair's name
  std::string text;
  for (const Pair pair : all_pairs) {
    if (!candidate.has_routine_for(pair)) continue;
    text += (text.empty() ? "" : ", ") + std::string(pair_name(pair)).substr(before.size());
  }
  return text;
}

/// A line, or several on a narrow terminal, below a name.
void print_below(const std::string& text) { print(standard_output().below(text)); }

void print_candidate(const Candidate& c) {
  print(fmt::format("{} {}\n", c.name, c.version));
  print_below("cylinder against " + other_shapes(c));
  print_below(c.settings);
  if (!c.models.empty()) print_below("models " + c.models);
  if (c.parameter) {
    print_below(fmt::format("{}:N with N the {}, {} to {}", c.family, c.parameter->meaning,
                            c.parameter->min, c.parameter->max));
  }
}

void print_heading(const std::string& text) { print(standard_output().folded(text)); }

void list_candidates() {
  const std::vector<const Candidate*> usual = default_candidates();
  for (const Candidate* c : usual) print_candidate(*c);
  for (const Skipped& s : skipped_plugins()) print_heading(s.name + ": skipped; " + s.reason);
  print_heading("Variants of these, when one is named or with --all-candidates:");
  for (const Candidate* c : all_candidates()) {
    if (std::ranges::find(usual, c) == usual.end()) print_candidate(*c);
  }
  print_heading(
      "In single precision, with Touchstone's contacts installed or with floors of triangles, when "
      "one is named:");
  for (const std::string& name : named_candidates()) print_below(name);
  const std::vector<std::string> peers = peer_engines();
  if (!peers.empty()) print_heading("Of engines outside Debian, when one is named:");
  for (const std::string& name : peers) print_below(name);
  print_heading("From npm, when one is named:");
  for (const NpmEngine& engine : npm_engines()) {
    const std::string obstacle = npm_obstacle(engine);
    print_below(std::string(engine.family) +
                (obstacle.empty() ? "" : ": unavailable; " + obstacle));
  }
}

constexpr std::size_t name_column = 24;

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
    if (m.kind != ModifierKind::tilt) {
      text += list_entry(m.name, name_column, m.description);
    } else if (!has_tilt) {
      has_tilt = true;
      text += list_entry("tilted-1e-K", name_column,
                         "A is tilted by 1e-1 to 1e-15 rad about its centre.");
    }
  }
  return text;
}

std::string arrangement_list(Pair pair) {
  std::string text = fmt::format("Arrangements of {}:\n", pair_name(pair));
  for (const Arrangement& a : arrangements(pair)) {
    text += list_entry(a.name, name_column, a.description);
  }
  return text;
}

std::string group_list() {
  return "Groups:\n" +
         list_entry("everyday", name_column,
                    "Sizes within 1:20, turned at random, shallow, resting or apart: what scenes "
                    "produce.") +
         list_entry("degenerate", name_column,
                    "Exact, nearly exact (tilted, touching) or symmetric.") +
         list_entry("extreme", name_column,
                    "Needles, coins, plates, uneven sizes, tiny, huge, far away, or deep.") +
         list_entry("recorded", name_column,
                    "As it occurred in the scenes that come with Touchstone.");
}

std::string motion_list() {
  std::string text;
  for (const CastMotion& motion : cast_motions()) {
    text += list_entry(motion.name, name_column, motion.description);
  }
  return text;
}

void list_classes(const std::string& pair) {
  std::vector<Pair> pairs(std::begin(all_pairs), std::end(all_pairs));
  if (!pair.empty()) pairs = {parse_pair(pair, "pair")};
  for (const Pair each : pairs) print(fmt::format("{}\n", arrangement_list(each)));
  print_heading("Modifiers, any number of them in any order, as in parallel-side+turned:");
  print(fmt::format("{}\n{}\n", modifier_list(pairs), group_list()));
  print_heading("Motions of casts, after an identity, as in cylinder-box/rim-face/1/0/grazing:");
  print(motion_list());
  for (const Pair each : pairs) {
    print_heading(fmt::format("A report scores {} classes of {}, a campaign {}.",
                              pose_classes(each).size(), pair_name(each),
                              pose_classes(each, Coverage::triples).size()));
  }
}

struct ListArguments {
  std::string what, pair;
};

int run_list(const ListArguments& options) {
  if (options.what == "classes") {
    list_classes(options.pair);
  } else if (options.what != "candidates") {
    throw InvalidInput("what", in_quotes(options.what), "must be candidates or classes");
  } else if (!options.pair.empty()) {
    throw InvalidInput("pair", in_quotes(options.pair),
                       "must be left out: candidates are listed with their pairs");
  } else {
    list_candidates();
  }
  return 0;
}

}  // namespace

void add_list(Program& program) {
  Command command = program.command("list", "List the contact routines, or the pose classes");
  const auto options = std::make_shared<ListArguments>();
  command.text("what", "LIST", options->what, "candidates, or classes: arrangements and modifiers")
      .required();
  command.text("pair", "PAIR", options->pair, "Classes of this pair alone, as cylinder-box");
  command.footer(
      "Examples:\n"
      "  touchstone list candidates\n"
      "  touchstone --load ./my_engine.so list candidates\n"
      "  touchstone report --candidates reference,bullet,prism:8,16\n"
      "  touchstone list classes cylinder-box\n"
      "  touchstone report --class side-on-face,side-on-face+turned --pair cylinder-box\n"
      "A family with a parameter is named with its number, as prism:16; what is skipped\n"
      "or unavailable says why.");
  command.runs([options] { return run_list(*options); });
}

}  // namespace touchstone
