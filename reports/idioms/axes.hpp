#pragma once

#include "candidates/host/candidate_process.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

// Engines whose cylinders lie along another axis than z, 'x' or 'y', get the world with its axes
// renamed, so that what lay along z lies along theirs: all numbers stay as they are.

Vec3 renamed(const Vec3& v, char axis);

/// As the engine has it: cylinders and capsules along that axis of their frames.
Configuration renamed(const Configuration& c, char axis);

/// The answer of a candidate, whose cylinders lie along z, to the renamed configuration, with the
/// world's axes as they were.
Answer answer_in_axis(CandidateProcess& process, const Configuration& c, char axis);

}  // namespace touchstone
