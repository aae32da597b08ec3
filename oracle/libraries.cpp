#include <CGAL/version.h>
#include <arb.h>
#include <flint/flint.h>
#include <gmp.h>
#include <mpfr.h>

#include <Eigen/Core>

#include "oracle/truth.hpp"

namespace touchstone::oracle {

std::vector<std::string> libraries() {
  const auto eigen = std::to_string(EIGEN_WORLD_VERSION) + '.' +
                     std::to_string(EIGEN_MAJOR_VERSION) + '.' +
                     std::to_string(EIGEN_MINOR_VERSION);
  return {std::string("CGAL ") + CGAL_VERSION_STR,   std::string("GMP ") + gmp_version,
          std::string("MPFR ") + mpfr_get_version(), std::string("FLINT ") + flint_version,
          std::string("Arb ") + arb_version,         "Eigen " + eigen};
}

}  // namespace touchstone::oracle
