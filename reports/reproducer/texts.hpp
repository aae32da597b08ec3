#pragma once

#include <functional>
#include <map>
#include <string>

#include "oracle/first_touch.hpp"
#include "oracle/truth.hpp"
#include "reference/configuration.hpp"
#include "reports/replay.hpp"

namespace touchstone {

/// What stands for the names in a reproducer's template.
using Texts = std::map<std::string, std::string, std::less<>>;

/// How a language writes doubles to the last bit.
enum class NumberStyle { hexadecimal, decimal };

/// The configuration of exactly the numbers that a candidate is given.
Configuration as_asked(const Configuration& configuration);

/// The numbers that the candidates are given (unit normals and quaternions in double), and what
/// engines with other axes get.
Texts question_texts(const Configuration& c, NumberStyle numbers);

/// The truth, and what is allowed.
Texts truth_texts(const Configuration& c, const oracle::Truth& truth, const Bar& bar,
                  NumberStyle numbers);

/// The truth of a cast, and what is allowed. `touch`: decided.
Texts cast_texts(const Configuration& c, const Vec3& sweep, const oracle::FirstTouch& touch,
                 const Bar& bar, NumberStyle numbers);

/// Jolt's convex radii, by a rule for the smallest half extent of a shape.
Texts convex_radius_texts(const Configuration& c, const std::function<double(double)>& rule);

}  // namespace touchstone
