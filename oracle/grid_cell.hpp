#pragma once

#include <gmpxx.h>
#include <optional>

#include "oracle/enclosure.hpp"

namespace touchstone::oracle {

/// Enclosures that depend on the enclosed number alone, not on how it was computed: the cells of a
/// grid whose spacing is a power of two. The grid is shifted by an odd fraction of its spacing, so
/// that no number that a configuration of doubles is likely to make lies between two cells.
class GridCell {
 public:
  /// Spacing: the largest power of two not above `width` times `size`, both > 0.
  GridCell(double size, double width);

  /// The cell that holds all of [lo, hi], if it is certain which: it must not reach zero, and is
  /// halved until it does not. None if the numbers lie in several cells or have no common sign.
  std::optional<Enclosure> around(const mpq_class& lo, const mpq_class& hi) const;

  /// ±2^-bits of the size.
  Enclosure nearly_zero(long bits) const;

 private:
  mpq_class size_, spacing_;
};

}  // namespace touchstone::oracle
