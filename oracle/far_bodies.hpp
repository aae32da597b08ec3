#pragma once

#include <optional>

#include "oracle/difference.hpp"

namespace touchstone::oracle {

/// Bodies that lie apart by more than 2^bits times their sizes are answered nearer by, in the same
/// direction: coordinates of a thousand bits would only make roots that lie 2^-1000 apart.
///
/// With D the distance of the centres, d̂ its direction, S the sum of all sizes and h the half width
/// of the difference body, g(d̂) = D − h(d̂) is a lower bound of σ, and the distance of the support
/// points along d̂ an upper one:
///
///   D − h(d̂) <= σ <= D − h(d̂) + S² / (2 (D − S)),
///
/// so that σ changes with D as D does, to within S 2^-bits.
class FarBodies {
 public:
  /// Moves the bodies of the difference together. None if they are near, or there is but one
  /// segment, with which no polynomial arises.
  static std::optional<FarBodies> brought_nearer(Difference& difference, int bits);

  /// By how much the signed distance is larger than what it now is, in units.
  Ball shift() const;
  /// By how much that may be wrong.
  const mpq_class& error() const { return error_; }

 private:
  FarBodies(const Difference& before, const Difference& after, mpq_class error);

  IntegerVector before_, after_;
  Integer norm_;
  mpq_class error_;
};

}  // namespace touchstone::oracle
