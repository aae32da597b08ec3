#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulation/scenes/trajectory.hpp"

namespace touchstone {

/// How much of a run is kept.
struct RecordingOptions {
  std::uint64_t count = 40;  ///< configurations of each pair of shapes, at most
  std::uint64_t seed = 1;
};

/// A configuration near contact that occurred in a run, for others like it.
struct RecordedQuestion {
  JudgedAnswer answer;
  std::uint64_t weight;  ///< number of questions that it stands for
};

/// Signed distance, as a share of the smaller size, below which bodies are near contact: what
/// overlaps, and what will in the next steps. A narrow phase is also asked about bodies that are
/// far apart, because their boxes overlap; these say nothing about contacts.
inline constexpr double near_contact = 0.05;

/// Samples the questions near contact of a run. Those of each pair of shapes, ordered by bodies and
/// then by time, are divided into equal parts, and one of each part is drawn: every question is
/// equally likely, and the sample is spread evenly over pairs of bodies and over time.
std::vector<RecordedQuestion> sample_near_contact(const Scene& scene, const Trajectory& run,
                                                  const RecordingOptions& options);

/// JSON Lines of {"id": "log-pile/left and upper/0.25", "scene", "weight", "configuration"}; the id
/// has the bodies' names and the time in seconds.
std::string recording_lines(const std::string& scene_name, const Scene& scene,
                            const Trajectory& run, const std::vector<RecordedQuestion>& questions);

}  // namespace touchstone
