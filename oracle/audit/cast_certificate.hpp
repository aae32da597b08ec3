#pragma once

#include "oracle/audit/certificate.hpp"
#include "reference/sweep.hpp"

namespace touchstone::audit {

/// A proof that A, as it moves and turns, comes as far as a part of its sweep without
/// overlapping B, and next to B there, if that is not the whole of it (oracle/truth.md,
/// oracle/check_certificate.py).
struct CastCertificate {
  /// From where the one before ends, A and B do not overlap along this normal.
  struct Part {
    mpq_class until;  ///< of the sweep
    RationalVector normal;
  };
  std::vector<Part> apart;
  /// Unless they are apart during the whole sweep: where the last part ends, these points are no
  /// farther apart than `distance` metres, with the roundings added.
  std::optional<RationalPair> pair;
  mpq_class distance;
};

/// Proves where A comes next to B, to within some roundings of all lengths; with a spin no nearer
/// than 900 steps lead, of which each leaves a part of the distance. Throws InvalidInput (field
/// "sweep") unless all lengths are finite and the bodies are proven apart at the start, and (field
/// "spin") of a spin above 100 radians.
CastCertificate certify_cast(const Configuration& configuration, const Sweep& sweep);

}  // namespace touchstone::audit
