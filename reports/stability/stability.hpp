#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "properties/files/named_members.hpp"
#include "properties/motions/motion.hpp"

namespace touchstone {

struct Terminal;

// How answers change at tiny steps and along slow motions (docs/motion.md): measured once
// (measure.hpp), then read by the table, the page and the JSON. Lengths are in sizes of the smaller
// shape; a measure is absent where there was nothing to measure.

/// The amplitudes of small steps: 1e-16, 1e-15, … 1e-1.
inline constexpr int amplitude_count = Decade::max - Decade::min + 1;
inline Decade amplitude(std::size_t i) { return Decade(Decade::min + static_cast<int>(i)); }
template <class Value>
using ByAmplitude = std::array<Value, amplitude_count>;

/// Small steps of body A around configurations of each class.
struct Amplification {
  /// The largest of each measure of one candidate in one class.
  struct Row {
    std::string pair, pose_class, candidate;
    ByAmplitude<std::optional<double>> amplification;  ///< change of depth / what the step allows
    ByAmplitude<std::optional<double>> hull_excess;    ///< movement of points beyond the patch's
    ByAmplitude<std::optional<double>> regret;         ///< of the normal after the step
    std::optional<double> jump;                        ///< change of depth beyond the true change
    ByAmplitude<int> points_changed, missed, unanswered;  ///< numbers of steps
  };
  struct TruthRow {
    std::string pair, pose_class;
    ByAmplitude<std::optional<double>> amplification;
  };
  /// The worst step of one pair × candidate by one measure.
  struct WorstStep {
    std::string pair, pose_class, candidate;
    std::string measure;  ///< "amplification", "hull_excess"
    double value;
    std::string from, to;  ///< names of the two configurations
  };
  std::uint64_t seed = 1;
  std::uint64_t count = 0;  ///< steps at each amplitude of each class
  std::vector<Row> results;
  std::vector<TruthRow> truth;
  std::vector<WorstStep> worst;
};

/// Outcomes around critical poses, as pictures.
struct FailureMaps {
  struct Picture {
    std::string candidate;
    std::vector<std::string> letters;  ///< of each zoom, row by row from the top (map_letters)
  };
  struct Pose {
    std::string name, description, pair;
    std::string columns, rows;  ///< what changes along them
    std::vector<Picture> pictures;
  };
  int stride = 1;  ///< every so many columns and rows were asked
  std::vector<Decade> zooms;
  std::vector<Pose> poses;
};

/// The meaning of a pixel: outcomes as in reports, and contacts that agree but do not hold the
/// contact patch.
struct MapLetter {
  char letter;
  const char* meaning;
};
inline constexpr MapLetter map_letters[] = {
    {'.', "agree"},           {'m', "missed"},         {'p', "phantom"},    {'s', "shallow"},
    {'o', "overdeep"},        {'n', "wrong-normal"},   {'f', "few-points"}, {'i', "not-finite"},
    {'x', "failed"},          {'c', "crashed"},        {'t', "timed-out"},  {'S', "shallow-points"},
    {'O', "overdeep-points"}, {'P', "phantom-points"}, {'B', "off-body"},   {'N', "no-points"},
    {'u', "unseen"}};

/// Slow motions through degenerate poses.
struct Sequences {
  /// The largest value of a measure, and the step at whose end it was.
  struct Peak {
    double value;
    int step;
  };
  struct Row {
    std::string candidate;
    std::optional<double> amplification;
    std::optional<Peak> jump, hull, hull_excess;
    int points_changed = 0;                     ///< steps
    int missed = 0, wrong = 0, unanswered = 0;  ///< poses
  };
  struct Course {
    std::string motion, description, pair;
    double displacement;         ///< largest of a step
    double true_depth_change;    ///< largest of a step
    double true_patch_movement;  ///< largest of a step
    std::vector<Row> results;
  };
  int steps = 0;
  std::vector<Course> motions;
};

struct Stability {
  std::vector<std::string> candidates;  ///< names
  double tolerance, threshold;
  std::optional<Amplification> amplification;
  std::optional<FailureMaps> maps;
  std::optional<Sequences> sequences;
};

// Numbers as tables and charts show them.

/// Two significant digits; zero below the rounding of doubles.
double short_number(double value);
/// A ratio to a bound, to two decimals upwards: 1 stands for at most 1 + 1e-9.
double rounded_up(double ratio);

/// What a person reads of it in a terminal.
std::string stability_table(const Stability& stability, const Terminal& terminal);

/// Member "stability" of report.json, and stability.json without its header.
nlohmann::json to_json(const Stability& stability);
std::string json_text(const Stability& stability);

/// Writes stability.json and stability.html into the folder. Throws InvalidInput (field "--out").
void write_stability(const Stability& stability, const std::string& command,
                     const std::filesystem::path& folder);

}  // namespace touchstone
