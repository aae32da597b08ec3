#pragma once

#include <functional>
#include <map>
#include <string>

#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

/// What stands for the names in a template.
using Texts = std::map<std::string, std::string, std::less<>>;

/// How a language writes doubles to the last bit.
enum class NumberStyle { hexadecimal, decimal };

/// The numbers that the candidates are given (unit normals and quaternions in double), and what
/// engines with other axes get.
Texts question_texts(const Configuration& configuration, NumberStyle numbers);

/// The truth, and what is allowed.
Texts truth_texts(const Configuration& configuration, const oracle::Truth& truth, const Bar& bar,
                  NumberStyle numbers);

/// Jolt's convex radii, by a rule for the smallest half extent of a shape.
Texts convex_radius_texts(const Configuration& configuration,
                          const std::function<double(double)>& rule);

}  // namespace touchstone
