#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "properties/identity.hpp"
#include "properties/motions/critical_pose.hpp"
#include "properties/motions/motion.hpp"

namespace touchstone {

// Names that rebuild one configuration bit for bit anywhere, beside identities:
//   map/standing/1e-12/-3/16          a pixel: pose, zoom, column, row
//   sequence/roll-over-edge/113/200   a step of a motion: its number of how many

std::string pixel_name(const CriticalPose& pose, Decade zoom, int column, int row);
std::string step_name(const Motion& motion, int step, int steps);

/// The configuration of such a name; nothing where the text does not begin like one. Throws
/// InvalidInput that names the part.
std::optional<Subject> named_configuration(const std::string& text);

/// "cylinder-box/parallel-side/1/4@1e-8/1/4", of the name of what was perturbed.
std::string perturbed_name(const std::string& base, const Perturbation& perturbation);

}  // namespace touchstone
