#pragma once

#include <string>
#include <string_view>

#include "reports/idioms/cases.hpp"
#include "reports/reproducer/programs.hpp"
#include "reports/reproducer/texts.hpp"

namespace touchstone {

// What stands for the names in the template of one case.

/// Languages of idioms alone: parry's crate, and models of MuJoCo.
extern const Language rust, model_language;

/// How an engine writes rotations and the axis of its cylinders.
struct Habit {
  char axis;
  bool real_part_first;
};

/// "rim_face" of "rim-face", as a name in Python and Rust.
std::string with_underscores(std::string name);

/// Numbers as Rust wants them: 1.0 for 1.
std::string with_points(std::string_view numbers);

/// What stands for numbers in the part that asks, where they are a case's.
Texts names_in_javascript();

/// `engine`: its name and version, for a sentence on what it does.
Texts case_texts(const IdiomCase& c, const std::string& engine, const Language& language,
                 Habit habit);

/// What the tests of Jolt have beside that, whose judge is in each.
Texts jolt_texts(const IdiomCase& c, const Bar& bar);

/// How the bodies lie, as a tag of Jolt's tests.
std::string_view tag_of_distance(const IdiomCase& c);

}  // namespace touchstone
