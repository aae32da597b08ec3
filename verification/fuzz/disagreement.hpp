#pragma once

#include <optional>
#include <string>

#include "oracle/truth.hpp"
#include "reference/contact_of.hpp"

namespace touchstone {

/// What our routines answer to one configuration.
struct OwnAnswers {
  SignedDistance distance;
  CertifiedDistance certified;
  Contact contact;  ///< with the threshold zero
  bool overlaps;
};
OwnAnswers own_answers(const Configuration& configuration);

/// A sentence where answers contradict each other, or the truth where that is given: a distance or
/// normal by more than 1e-13 of the larger size or the bodies' distance, a bound that does not
/// hold, a contact that is missing or is none, a deepest point that is deeper than the bodies or
/// none that is as deep.
std::optional<std::string> disagreement(const Configuration& configuration,
                                        const OwnAnswers& answers, const oracle::Truth* truth);

}  // namespace touchstone
