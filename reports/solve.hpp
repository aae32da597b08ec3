#pragma once

#include <iosfwd>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "candidates/host/candidate_process.hpp"
#include "oracle/audit/cast_certificate.hpp"
#include "oracle/audit/enclose.hpp"
#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"

namespace touchstone {

/// The two oracles exclude each other: one of them is wrong. `what()` holds both answers and the
/// configuration, every number as a hexadecimal float.
class Contradiction : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

struct SolveOptions {
  std::vector<const Candidate*> candidates;
  double width = 1e-30;  ///< of the truth, relative to the larger size
  Bar bar;
  bool audit = false;    ///< let the second oracle check every truth
  Limits limits = {};    ///< of each candidate on one configuration
  unsigned workers = 1;  ///< processes; they do not change what is written
  bool csv = false;      ///< a row for each line and candidate instead of JSON
};

/// One JSON object a line in, one a line out (docs/your-poses.md), in the order of the lines; with
/// one worker each as soon as its line has come. A bad line is answered with an error and the rest
/// go on; returns false if there was any. Throws Contradiction if the two oracles disagree, or,
/// from a worker, what says so.
bool solve(std::istream& in, std::ostream& out, const SolveOptions& options);

// What the second oracle says, held against the first one and written down:

/// Throws Contradiction unless the two enclosures have a point in common and no pair of points is
/// closer than the bodies are said to be.
void check_agreement(const Configuration& configuration, const oracle::Enclosure& truth,
                     const audit::Enclosure& audit);

/// {"signed_distance": [lo, hi] as decimals rounded outward, "primal_dual_gap": by how much a pair
/// of points is farther apart than the gap along one direction, null unless the bodies are apart}.
nlohmann::json to_json(const audit::Enclosure& audit);

/// The certificate with the configuration that it is about, one JSON object (oracle/truth.md).
std::string certificate_json(const audit::Certificate& certificate,
                             const Configuration& configuration);
std::string certificate_json(const audit::CastCertificate& certificate,
                             const Configuration& configuration, const Sweep& sweep);

}  // namespace touchstone
