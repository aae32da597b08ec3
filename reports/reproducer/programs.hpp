#pragma once

#include <span>
#include <string>
#include <string_view>

#include "candidates/candidates.hpp"
#include "reference/configuration.hpp"
#include "reports/reproducer/fill_template.hpp"
#include "reports/reproducer/texts.hpp"

namespace touchstone {

// The programs that ask an engine: a table over the files of candidates/reproducers.

struct Language {
  std::string_view name;    ///< for --language
  std::string_view remark;  ///< begins one
  const std::string_view& shared;
  NumberStyle numbers;
};
extern const Language cpp, javascript, python;

/// A program that asks an engine.
struct Program {
  std::string_view engine;     ///< name for --emit, without parameter
  std::string_view candidate;  ///< gives the answers that it repeats
  std::string_view title;
  const Language& language;
  const std::string_view& source;
  std::string_view tags;  ///< for its lines, with commas
  bool plane = true;      ///< it has a routine for the half-space
};

/// Those that need nothing of ours. The first of an engine is the usual one.
std::span<const Program> programs();

/// Does it ask about a floor of triangles?
bool has_floor(const Program& program);

/// Has the program lines for casts of the pair?
bool knows_casts(const Program& program, Pair pair);

/// Has the program lines for the pair? Those that know convex bodies have lines for them.
bool knows(const Program& program, Pair pair);

/// "jolt-margin" of "jolt-margin:0.02".
std::string_view family_of(std::string_view name);

/// A string of C and Python.
std::string string_literal(std::string_view text);

/// The tags of its lines for that pair.
std::string_view tags_for(const Program& program, Pair pair);
/// The same, and "cast" or "contact": whichever is asked for.
Tags tags_for(const Program& program, Pair pair, bool of_cast);

/// "release" where the name of an engine of npm has one, which may lack what the newest has.
std::string_view tag_of_release(std::string_view name);

/// What stands in the programs of npm's engines alone. `name`: that of the engine as it was given.
/// Throws InvalidInput (field "--emit").
Texts npm_texts(const Program& program, std::string_view name, const Candidate* candidate,
                const Configuration& c);

}  // namespace touchstone
