#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "candidates/ts_shape.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

struct Limits;
class Respondent;

/// An option that added candidates.
struct Added {
  std::string option;  ///< "--load", "--candidate-command"
  std::string value;   ///< a file's absolute path, or the command
};

/// The description of one candidate. What is not ours is called in other processes only
/// (candidate_process.hpp).
struct Candidate {
  /// A shared object (docs/engine.md).
  struct Plugin {
    std::filesystem::path file;  ///< absolute
    int index;                   ///< among the plug-in's candidates
  };
  /// A program that speaks as candidates/host/protocol.md says.
  struct Command {
    std::string line;              ///< for /bin/sh -c
    std::filesystem::path folder;  ///< in which it runs, absolute
    bool in_frames;                ///< its messages are frames; otherwise lines of JSON
  };
  /// A function of this program (python/): makes what answers.
  using Function = std::function<std::unique_ptr<Respondent>(const Limits&)>;

  struct Parameter {
    std::string meaning;
    double min, max, usual;
    bool whole, bare;
  };

  std::string name;      ///< for a family's member with its parameter: "prism:16"
  std::string family;    ///< the name without the parameter: "prism"
  std::string version;   ///< the engine's
  std::string settings;  ///< how it is called
  std::string models;  ///< what represents the shapes in a simplified model; empty if they are used
                       ///< as they are
  std::optional<Parameter> parameter;
  double value = 0;                          ///< of the parameter
  std::array<bool, shape_kinds> supports{};  ///< by ts_shape_kind
  std::string precision;                     ///< of a command or function: "double" or "float"
  std::string runs = "native";               ///< "native", "wasm" or "script"
  std::variant<Plugin, Command, Function> origin;
  std::optional<Added> added;  ///< what brought it; absent for those that Touchstone has

  /// Null if it is something else.
  const Plugin* plugin() const { return std::get_if<Plugin>(&origin); }
  const Command* command() const { return std::get_if<Command>(&origin); }
  bool has_routine_for(Pair pair) const;
};

/// All candidates in the order in which reports list them: those of the installed standard
/// plug-ins, with the usual member of each family, then the added ones.
std::vector<const Candidate*> all_candidates();

/// Those of them that are asked where none are named: the added ones, and each engine and model as
/// it is mostly used, without the variants.
std::vector<const Candidate*> default_candidates();

/// Those built here that are candidates once they are named, and in no list before or after: our
/// routines in single precision, "reference-float", engines that answer with Touchstone's contacts
/// of cylinders (reference/engines), "ode+touchstone", and floors of triangles, "ode-floor".
std::vector<std::string> named_candidates();

/// Likewise the candidates built here of engines that Debian does not have: "coal", "jolt-native".
std::vector<std::string> peer_engines();

/// The candidate of that name, "bullet" or "prism:32"; valid as long as the program runs. Throws
/// InvalidInput (field "--candidates") that lists the existing names or the parameter's range.
const Candidate& find_candidate(std::string_view name);

/// The candidate of that name if it is known by now, be it added or found; null otherwise.
const Candidate* known_candidate(std::string_view name);

/// How a candidate of that name runs ("native", "wasm", "script"), if it is known by now; "native"
/// otherwise.
std::string runs_as(std::string_view name);

/// Candidates by name, and families by several numbers: {"bullet", "prism:8", "16",
/// "spheres:1..64"} are bullet, prism:8, prism:16 and spheres of 1, 2, 4, … 64. A range doubles
/// where the parameter is a whole number and goes by factors of ten otherwise. Throws like
/// find_candidate.
std::vector<const Candidate*> find_candidates(const std::vector<std::string>& names);

/// Adds the candidates of a file: a plug-in, or, if its name ends in ".txt", a list of commands,
/// one a line, which run in the file's folder; "#" begins a comment. Throws InvalidInput (field
/// "--load") if a plug-in is of an interface version that is not read, dies while it is loaded, or
/// has a candidate whose name is taken; for a list like add_command, with the line.
void add_file(const std::filesystem::path& file);

/// Adds the candidate that a command for /bin/sh says it is, and that runs in this folder. Throws
/// InvalidInput (field "--candidate-command") if it does not say so as
/// candidates/host/protocol.md specifies, or has a name that is taken.
void add_command(const std::string& command,
                 const std::filesystem::path& folder = std::filesystem::current_path());

/// The options that added candidates, in order.
const std::vector<Added>& added_candidates();

/// A standard plug-in that could not be used.
struct Skipped {
  std::string name;
  std::string reason;
};
const std::vector<Skipped>& skipped_plugins();

/// The folder of the standard plug-ins, and of what else this program loads: in the build tree
/// above the program, or under the prefix of an installed one.
std::filesystem::path standard_folder();
/// Whether that lies in the build folder of a clone, whose ./touchstone starts this program.
bool is_in_clone();

/// Convert a shape or a pose to the C interface; quaternions and plane normals are normalised in
/// double. Pointers lead into a convex body, which has to live as long.
ts_shape to_ts_shape(const Shape& shape);
ts_pose to_ts_pose(const Pose& pose);

}  // namespace touchstone
