#pragma once

#include <string>

#include "reports/report.hpp"

namespace touchstone {

// One configuration shown to a person. `description` is that of its pose class; empty without one.
// Preconditions: the examination has its truth.

/// Its numbers (as a line for `solve`, as exact fractions, in hexadecimal floats), the truth, and
/// each candidate's answer and score.
std::string replay_text(const Examination& examination, const std::string& description);

/// One JSON object, as in a report's worst cases.
std::string replay_json(const Examination& examination);

/// One self-contained page: both bodies in three dimensions and in a slice through the contact,
/// with the contact points and normals of truth and candidates, and all numbers. Nothing is loaded
/// from elsewhere.
std::string replay_page(const Examination& examination, const std::string& description);

}  // namespace touchstone
