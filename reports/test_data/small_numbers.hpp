#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "oracle/patch/contact_patch.hpp"
#include "oracle/truth.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

// Configurations of fewer digits, in which the bodies meet as they did.

/// A case is left out if its verdict is another one with the tolerance by this factor smaller or
/// larger: another compiler or processor might find that.
inline constexpr double sure = 3;

/// How the bodies meet, which must stay as it is when numbers become smaller.
struct Meeting {
  enum class Kind { apart, near, touching, shallow, deep } kind;
  oracle::Ties ties;
  oracle::Alignment to_a;
  std::array<oracle::Alignment, 3> to_b;
  std::size_t vertices;
  decltype(std::declval<oracle::ContactPatch>().kind()) patch;
  bool operator==(const Meeting&) const = default;
};
Meeting meeting_of(const Configuration& configuration, const oracle::Truth& truth,
                   double tolerance);

/// Lengths as multiples of a power of two, so many bits below the smaller size, orientations in
/// whole numbers: in B's frame, or as they are. Throws InvalidInput where a hull loses its corners.
Configuration on_grid(const Configuration& configuration, bool in_frame_of_b, int bits);

/// Moves A by the signed distance: exactly, where the normal lies along an axis of the world.
void touch(Configuration& configuration);

/// All numbers rounded to floats; hulls are made anew.
Configuration in_floats(const Configuration& configuration);
/// Is each number one that floats have, not below the smallest normal one?
bool is_in_floats(const Configuration& configuration);

/// How far rounding to floats moves a body's surface, of sizes and distances. A number is rounded
/// by 2^-24 of it; an orientation turns by no more than 2^-22 then.
inline constexpr double float_rounding = 0x1p-22;
/// Of the numbers of both bodies as floats: how far rounding moves their surfaces, metres.
double moved_by_rounding(const Configuration& configuration);

}  // namespace touchstone
