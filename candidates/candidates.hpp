#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "candidates/candidate.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

/// Every candidate there is, in the order in which reports list them: those of the standard
/// plug-ins that are installed, of each family the usual member, then those of `add_plugin`.
std::vector<const Candidate*> all_candidates();

/// The candidate of that name, "bullet" or "prism:32". Valid as long as the program runs. Throws
/// InvalidInput (field "--candidates") naming those there are, or what a parameter must be.
const Candidate& find_candidate(std::string_view name);

/// Candidates by name, families by several numbers: {"bullet", "prism:8", "16", "spheres:1..64"}
/// are bullet, prism:8, prism:16 and spheres of 1, 2, 4, … 64. A range doubles where the parameter
/// is a whole number and goes by factors of ten otherwise. Throws like find_candidate.
std::vector<const Candidate*> find_candidates(const std::vector<std::string>& names);

/// Adds a plug-in's candidates. Throws InvalidInput (field "--candidate") when the file is no
/// plug-in of this interface version, dies while it is loaded, or brings a name that is taken.
void add_plugin(const std::filesystem::path& file);

/// The files of add_plugin, absolute, in order.
const std::vector<std::filesystem::path>& added_plugins();

/// A standard plug-in that could not be used.
struct Skipped {
  std::string name;
  std::string reason;
};
const std::vector<Skipped>& skipped_plugins();

/// A configuration's shapes and poses as the C interface passes them: quaternions and plane
/// normals normalised in double.
ts_shape to_ts_shape(const Shape& shape);
ts_pose to_ts_pose(const Pose& pose);

}  // namespace touchstone
