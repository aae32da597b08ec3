#pragma once

#include <array>

#include "contact.hpp"
#include "curves.hpp"

namespace touchstone {

/// A few points whose hull stands for a flat patch of this size, and what becomes of them as the
/// clearance has a slope. The patch's own corners stay what they are, so that the hull never jumps.
struct PatchLayout {
  /// Room for all that is added before it is reduced.
  static constexpr int capacity = 14;

  std::array<Vec2, capacity> points;
  int count = 0;
  double size;  ///< metres

  explicit PatchLayout(double size_of_patch) : size(size_of_patch) {}
  void add(const Vec2& p) { points[count++] = p; }

  /// Adds the deepest point, with that weight against the middle of the others. Once.
  void add_deepest(const Vec2& deepest, double weight);

  /// Leaves out points with slope·p above `bound`; in their stead come the ends of what their hull
  /// has there, to which it is cut off. At most three times.
  void cut_off(const Vec2& slope, double bound);

  /// Leaves eight, the deepest one among them: first out are those within the others' hull, then
  /// the two nearest become one.
  void reduce();

 private:
  struct Couple {
    int first, second;
  };
  Couple nearest_two() const;
  /// Removes points within the others' hull, as long as there are more than eight.
  void remove_within();
  void remove(int i);
  /// Adds a point, unless there is one that hardly differs.
  void add_apart(const Vec2& p);

  int deepest_ = -1;  ///< which point is
};

}  // namespace touchstone
