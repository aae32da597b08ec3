#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "oracle/truth.hpp"
#include "reference/configuration.hpp"
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

/// A configuration of any bytes, missing ones being zero: always a valid one. Most of its numbers
/// stand as a choice of a byte or as a number of seven more: sizes equal an earlier one, axes are
/// parallel or perpendicular, offsets are sums of sizes, each but for a difference of any magnitude
/// down to 2^-60. So bytes that are changed one by one walk from case to case, and to what lies
/// between. Sizes lie between 2^-7 and 2^7 metres, both bodies in any frame.
Configuration configuration_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace touchstone
