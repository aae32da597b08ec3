// Exactly parallel bodies that lie beyond each other's caps and sides at once, or within each
// other.
#include <utility>

#include "properties/lattice.hpp"
#include "properties/pose_class.hpp"

namespace touchstone {
namespace {

/// A above B and beside it: rim against rim, edge or round end.
Placement diagonally_beyond(Draw& draw, Pair pair, const Sizes& s, Clearance clearance) {
  if (pair == Pair::capsule) {
    // The end's ball meets the rim along the diagonal of a triangle of 3, 4 and 5.
    const Steps part = (s.radius_b - draw_depth(draw, s, clearance)) / 5;
    return {s.radius_a + 3 * part, 0, s.half_a + s.half_b + 4 * part};
  }
  const Steps beside = draw_depth(draw, s, clearance), above = draw_depth(draw, s, clearance);
  const Steps along_edge = has_faces(pair) ? draw_offset(draw, s.other_b / 2) : 0;
  return {s.radius_a + s.radius_b - beside, along_edge, s.half_a + s.half_b - above};
}

Arrangement diagonal(Pair pair) {
  const auto generate = [pair](Draw& draw, const Modifiers& m) {
    const Clearance asked = m.clearance();
    const Clearance clearance = asked == Clearance::usual ? Clearance::apart : asked;
    const Lattice lattice(draw, m.frame());
    Sizes sizes = draw_sizes(draw, lattice, m);
    if (pair == Pair::capsule) sizes.radius_b -= sizes.radius_b % 5;
    return place(draw, pair, lattice, sizes, diagonally_beyond(draw, pair, sizes, clearance));
  };
  // Overlapping, the cap or the side of bodies that have edges is nearer than those.
  std::vector<Clearance> clearances = {Clearance::touching};
  if (pair == Pair::capsule)
    clearances = {Clearance::shallow, Clearance::touching, Clearance::deep};
  Arrangement result{"diagonal",
                     "Exactly parallel bodies diagonally beyond each other's cap and side: the "
                     "normal lies between those two, and the least lean of one body decides where "
                     "on its rim.",
                     Arrangement::Orientations::exact, std::move(clearances), generate};
  result.own = Clearance::apart;
  return result;
}

/// Makes one of the bodies so long that a way out along the axes is longer than one sideways: one
/// whose proportions are as they come.
void lengthen(Sizes& s, Proportions proportions) {
  const auto [form_a, form_b] = forms(proportions);
  const bool is_a_usual = form_a == Form::usual;
  const bool is_b_usual = form_b == Form::usual && proportions != Proportions::plate;
  if (!is_a_usual && !is_b_usual) return;  // both are long
  const bool is_b = is_a_usual && is_b_usual ? s.radius_b > s.radius_a : is_b_usual;
  (is_b ? s.half_b : s.half_a) += s.radius_a + s.radius_b;
}

Arrangement contained(Pair pair) {
  const auto generate = [pair](Draw& draw, const Modifiers& m) {
    const Lattice lattice(draw, m.frame());
    Sizes sizes = draw_sizes(draw, lattice, m);
    const Steps radius = sizes.radius_b, breadth = has_faces(pair) ? sizes.other_b : radius;
    const Steps max_along = (sizes.half_a + sizes.half_b) / 2;
    lengthen(sizes, m.proportions());
    // Not beyond 0.85 of a round body's radius.
    const Steps x = draw.integer(1, 3 * radius / 5), y = draw.integer(1, 3 * breadth / 5);
    const Steps side = draw.coin() ? 1 : -1, along = draw_offset(draw, max_along);
    return place(draw, pair, lattice, sizes, {x, side * y, along});
  };
  Arrangement result{
      "contained",
      "Exactly parallel bodies lie within each other, the centre of neither on the other's axis: "
      "the way out is sideways, and only one of its two senses is short.",
      Arrangement::Orientations::exact,
      {},
      generate};
  result.own = Clearance::deep;
  return result;
}

}  // namespace

std::vector<Arrangement> parallel_arrangements(Pair pair) {
  if (pair == Pair::plane || pair == Pair::sphere) return {};
  std::vector<Arrangement> all = {diagonal(pair), contained(pair)};
  for (Arrangement& a : all) a.suite = 2;
  return all;
}

}  // namespace touchstone
