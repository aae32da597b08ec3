#include "oracle/patch/convex_set.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/General_polygon_set_2.h>
#include <CGAL/Gps_circle_segment_traits_2.h>
#include <cmath>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <vector>

#include "oracle/patch/feature_overlap.hpp"

namespace touchstone::oracle {
namespace {

constexpr double set_rounding = 1e-14;

/// The part of the unit disc with x >= cos(half_angle).
ConvexSet disc_segment(double half_angle) {
  const BoundaryPiece arc = BoundaryPiece::arc(Vec2::Zero(), 1, -half_angle, 2 * half_angle);
  return ConvexSet::region({arc, BoundaryPiece::line(arc.to, arc.from)});
}

TEST(ConvexSet, WholeDisc) {
  const ConvexSet disc = ConvexSet::region({BoundaryPiece::arc({3, 4}, 2, 1, 2 * pi)});
  EXPECT_NEAR(disc.area(), 4 * pi, set_rounding * 100);
  EXPECT_NEAR(disc.perimeter(), 4 * pi, set_rounding * 100);
  EXPECT_NEAR((disc.centroid() - Vec2(3, 4)).norm(), 0, set_rounding * 100);
  EXPECT_NEAR(disc.support({0, 1}), 6, set_rounding * 100);
  EXPECT_EQ(disc.distance({3, 4}), 0);
  EXPECT_NEAR(disc.distance({3, 7}), 1, set_rounding * 100);
  EXPECT_EQ(disc.outline(8).size(), 32u);
}

TEST(ConvexSet, HalfDiscHasItsCentroidAtFourThirdsOverPi) {
  const ConvexSet half = disc_segment(pi / 2);
  EXPECT_NEAR(half.area(), pi / 2, set_rounding);
  EXPECT_NEAR(half.perimeter(), pi + 2, set_rounding);
  EXPECT_NEAR(half.centroid().x(), 4 / (3 * pi), set_rounding);
  EXPECT_NEAR(half.centroid().y(), 0, set_rounding);
  EXPECT_NEAR(half.support({-1, 0}), 0, set_rounding);
  EXPECT_NEAR(half.distance({-1, 0}), 1, set_rounding);
  EXPECT_NEAR(half.distance({-3, 5}), std::hypot(3, 4), 10 * set_rounding);
}

TEST(ConvexSet, ThinDiscSegmentsKeepTheirDigits) {
  // area → 2/3 · chord · height; centroid → 3/5 of the height from the arc.
  const double t = 1e-5;
  const ConvexSet thin = disc_segment(t);
  EXPECT_NEAR(thin.area() / (2.0 / 3 * t * t * t), 1, 1e-9);
  EXPECT_NEAR((1 - thin.centroid().x()) / (t * t / 2), 3.0 / 5, 1e-5);
}

TEST(ConvexSet, RectangleFarFromTheOriginKeepsItsDigits) {
  const Vec2 o(1e8, -1e8);
  const ConvexSet r = ConvexSet::polygon({o, o + Vec2(2, 0), o + Vec2(2, 1), o + Vec2(0, 1)});
  EXPECT_EQ(r.area(), 2);
  EXPECT_EQ(r.perimeter(), 6);
  EXPECT_EQ(r.centroid(), o + Vec2(1, 0.5));
  EXPECT_EQ(r.distance(o + Vec2(5, 5)), 5);
}

TEST(ConvexSet, SegmentAndPoint) {
  const ConvexSet s = ConvexSet::polygon({Vec2(0, 0), Vec2(3, 4)});
  EXPECT_EQ(s.kind(), ConvexSet::Kind::segment);
  EXPECT_EQ(s.area(), 0);
  EXPECT_EQ(s.perimeter(), 5);
  EXPECT_EQ(s.centroid(), Vec2(1.5, 2));
  EXPECT_EQ(s.distance({1.5, 2}), 0);
  EXPECT_NEAR(s.distance({-3, -4}), 5, set_rounding);
  const ConvexSet p = ConvexSet::polygon({Vec2(1, 2)});
  EXPECT_EQ(p.kind(), ConvexSet::Kind::point);
  EXPECT_EQ(p.support({1, 1}), 3);
  EXPECT_EQ(p.distance({1, 4}), 2);
  EXPECT_EQ(p.outline(8).size(), 1u);
}

TEST(ConvexPolygon, HullDropsInnerPointsAndThoseOnItsSides) {
  const auto hull = plane_hull(
      std::vector<Vec2>{Vec2(0, 0), Vec2(1, 1), Vec2(2, 0), Vec2(1, 0), Vec2(2, 2), Vec2(0, 2)});
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_EQ(ConvexSet::polygon(hull).area(), 4);
  EXPECT_EQ(plane_hull(std::vector<Vec2>{Vec2(0, 0), Vec2(1, 1), Vec2(3, 3)}).size(), 2u);
  EXPECT_EQ(plane_hull(std::vector<Vec2>{Vec2(1, 1), Vec2(1, 1)}).size(), 1u);
}

TEST(ConvexPolygon, IntersectionOfSquares) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  const std::vector<Vec2> moved{{1, 1}, {3, 1}, {3, 3}, {1, 3}};
  EXPECT_EQ(ConvexSet::polygon(intersection(square, moved)).area(), 1);
  const std::vector<Vec2> away{{5, 0}, {6, 0}, {6, 1}};
  EXPECT_TRUE(intersection(square, away).empty());
  EXPECT_EQ(halfway(square, away), Vec2(3.5, 0));
}

TEST(ConvexPolygon, IntersectionWithASegmentIsWhatLiesInside) {
  const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, segment{{1, 1}, {5, 1}};
  for (const auto& common : {intersection(square, segment), intersection(segment, square)}) {
    ASSERT_EQ(common.size(), 2u);
    EXPECT_EQ((common[0] - common[1]).norm(), 1);
  }
}

const Vec3 seen_along(0, 0, 1);

SupportFeature a_disc(const mpq_class& x, const mpq_class& y, const mpq_class& radius) {
  SupportFeature f;
  f.kind = SupportFeature::Kind::disc;
  f.centre = {x, y, 0};
  f.u = {0, 0, 3};  // its length has no meaning
  f.radius = radius;
  return f;
}
SupportFeature a_segment(const mpq_class& x, const mpq_class& y, const mpq_class& dx,
                         const mpq_class& dy) {
  SupportFeature f;
  f.kind = SupportFeature::Kind::segment;
  f.centre = {x, y, 0};
  f.u = {dx, dy, 0};
  return f;
}
SupportFeature a_rectangle(const mpq_class& a, const mpq_class& b) {
  SupportFeature f;
  f.kind = SupportFeature::Kind::polygon;
  f.corners = {{-a, -b, 0}, {a, -b, 0}, {a, b, 0}, {-a, b, 0}};
  return f;
}
ConvexSet shared(const SupportFeature& a, const SupportFeature& b) {
  return overlap(a, b, seen_along)->shape;
}
/// In the plane of the features.
Vec2 middle_shared(const SupportFeature& a, const SupportFeature& b) {
  const Placement at = *overlap(a, b, seen_along);
  const Vec3 e1 = at.e1.normalized(), e2 = seen_along.cross(e1);
  const Vec2 p = at.shape.centroid();
  return (at.origin + p.x() * e1 + p.y() * e2).head<2>();
}

// Overlaps of discs, rectangles and segments against CGAL's exact polygons of circles and lines, on
// small integers, where tangent discs and circles through corners are frequent.

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Traits = CGAL::Gps_circle_segment_traits_2<Kernel>;
using PolygonSet = CGAL::General_polygon_set_2<Traits>;
using Polygon = Traits::Polygon_2;
using Point = Kernel::Point_2;

Polygon exact_disc(int x, int y, int radius) {
  const Traits::Curve_2 circle(
      Kernel::Circle_2(Point(x, y), radius * radius, CGAL::COUNTERCLOCKWISE));
  std::vector<CGAL::Object> pieces;
  Traits().make_x_monotone_2_object()(circle, std::back_inserter(pieces));
  Polygon result;
  for (const CGAL::Object& piece : pieces) {
    result.push_back(*CGAL::object_cast<Traits::X_monotone_curve_2>(&piece));
  }
  return result;
}

Polygon exact_rectangle(int a, int b) {
  const Point corners[] = {Point(-a, -b), Point(a, -b), Point(a, b), Point(-a, b)};
  Polygon result;
  for (int i = 0; i < 4; ++i) {
    result.push_back(Traits::X_monotone_curve_2(corners[i], corners[(i + 1) % 4]));
  }
  return result;
}

Vec2 rounded(const Traits::Point_2& p) { return {CGAL::to_double(p.x()), CGAL::to_double(p.y())}; }

/// CGAL's intersection: the number of its lines and arcs, and its area.
struct Region {
  int lines = 0, arcs = 0;
  double area = 0;
};

Region intersection(const Polygon& p, const Polygon& q) {
  PolygonSet set(p);
  set.intersection(q);
  std::vector<Traits::Polygon_with_holes_2> parts;
  set.polygons_with_holes(std::back_inserter(parts));
  Region region;
  for (const auto& part : parts) {
    // CGAL cuts circles at their left and right ends: pieces of one circle are one arc.
    std::vector<Traits::X_monotone_curve_2> curves(part.outer_boundary().curves_begin(),
                                                   part.outer_boundary().curves_end());
    for (std::size_t i = 0; i < curves.size(); ++i) {
      const auto& c = curves[i];
      const auto& before = curves[(i + curves.size() - 1) % curves.size()];
      const Vec2 a = rounded(c.source()), b = rounded(c.target());
      region.area += (a.x() * b.y() - a.y() * b.x()) / 2;
      if (c.is_linear()) {
        ++region.lines;
        continue;
      }
      const Vec2 centre(CGAL::to_double(c.supporting_circle().center().x()),
                        CGAL::to_double(c.supporting_circle().center().y()));
      const double radius2 = CGAL::to_double(c.supporting_circle().squared_radius());
      const double half = std::asin(std::min(1.0, (a - b).norm() / 2 / std::sqrt(radius2)));
      region.area += radius2 * (half - std::sin(2 * half) / 2);
      const bool continues = before.is_circular() && curves.size() > 1 &&
                             before.supporting_circle() == c.supporting_circle();
      if (!continues) ++region.arcs;
    }
    if (region.arcs == 0 && region.lines == 0) region.arcs = 1;  // a whole circle
  }
  return region;
}

void expect_same(const ConvexSet& ours, const Region& theirs) {
  if (theirs.lines + theirs.arcs == 0) {
    EXPECT_EQ(ours.kind(), ConvexSet::Kind::point);
    return;
  }
  ASSERT_EQ(ours.kind(), ConvexSet::Kind::region);
  int lines = 0;
  for (const BoundaryPiece& s : ours.sides()) lines += s.is_line() ? 1 : 0;
  EXPECT_EQ(lines, theirs.lines);
  EXPECT_EQ(static_cast<int>(ours.sides().size()) - lines, theirs.arcs);
  EXPECT_NEAR(ours.area(), theirs.area, 1e-12 * (1 + theirs.area));
}

TEST(FeatureOverlap, DiscsAreAsCgalHasThem) {
  for (int r = 1; r <= 4; ++r) {
    for (int s = 1; s <= 4; ++s) {
      for (int x = 0; x <= 9; ++x) {
        SCOPED_TRACE(testing::Message() << r << ' ' << s << ' ' << x);
        expect_same(shared(a_disc(0, 0, r), a_disc(x, 0, s)),
                    intersection(exact_disc(0, 0, r), exact_disc(x, 0, s)));
      }
    }
  }
}

TEST(FeatureOverlap, DiscAndRectangleAreAsCgalHasThem) {
  std::mt19937 random(1);
  const auto draw = [&](int lo, int hi) {
    return static_cast<int>(lo + random() % static_cast<unsigned>(hi - lo + 1));
  };
  for (int i = 0; i < 1500; ++i) {
    const int x = draw(-7, 7), y = draw(-7, 7), r = draw(1, 6), a = draw(1, 6), b = draw(1, 6);
    SCOPED_TRACE(testing::Message() << x << ' ' << y << ' ' << r << ' ' << a << ' ' << b);
    expect_same(shared(a_disc(x, y, r), a_rectangle(a, b)),
                intersection(exact_disc(x, y, r), exact_rectangle(a, b)));
  }
}

/// Every side starts where the previous one ends, and lies on the right disc or line.
void expect_closed(const ConvexSet& set) {
  for (std::size_t i = 0; i < set.sides().size(); ++i) {
    const BoundaryPiece& s = set.sides()[i];
    EXPECT_LE((s.to - set.sides()[(i + 1) % set.sides().size()].from).norm(), 1e-14 * 10);
    if (s.is_line()) continue;
    EXPECT_NEAR((s.from - s.centre).norm(), s.radius, 1e-14 * 10);
    EXPECT_NEAR((s.to - s.centre).norm(), s.radius, 1e-14 * 10);
    const BoundaryPiece again = BoundaryPiece::arc(s.centre, s.radius, s.start, s.sweep);
    EXPECT_LE((again.from - s.from).norm() + (again.to - s.to).norm(), 1e-14 * 20);
  }
}

TEST(FeatureOverlap, BoundariesAreClosed) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> anywhere(-3, 3), length(0.1, 3);
  for (int i = 0; i < 5000; ++i) {
    const double x = anywhere(random), y = anywhere(random), r = length(random);
    expect_closed(shared(a_disc(x, y, r), a_rectangle(length(random), length(random))));
    expect_closed(shared(a_disc(0, 0, r), a_disc(x, 0, length(random))));
  }
}

TEST(FeatureOverlap, ACornerJustWithinTheCircleLeavesNoFullTurn) {
  // The circle passes the corner (3, 4) at 1e-16 of its radius, on either side.
  for (const double r : {std::nextafter(5, 4), 5.0, std::nextafter(5, 6)}) {
    const ConvexSet set = shared(a_disc(0, 0, r), a_rectangle(3, 4));
    EXPECT_NEAR(set.area(), 48, 1e-13);
    EXPECT_NEAR(set.perimeter(), 28, 1e-13);
  }
}

TEST(FeatureOverlap, DiscAndSegmentOnSmallIntegers) {
  // Against the square roots in double; ties are integers and exact there too.
  for (int along = -6; along <= 6; ++along) {
    for (int off = 0; off <= 6; ++off) {
      for (int r = 1; r <= 5; ++r) {
        for (int h = 1; h <= 4; ++h) {
          const double half = r >= off ? std::sqrt(r * r - off * off) : -1;
          const double lo = std::max<double>(-h, along - half);
          const double hi = std::min<double>(h, along + half);
          const ConvexSet set = shared(a_segment(0, 0, h, 0), a_disc(along, off, r));
          const bool is_segment = half > 0 && lo < hi;
          EXPECT_EQ(set.kind(), is_segment ? ConvexSet::Kind::segment : ConvexSet::Kind::point);
          EXPECT_NEAR(set.perimeter(), is_segment ? hi - lo : 0, 1e-14 * 10);
        }
      }
    }
  }
}

TEST(FeatureOverlap, SegmentAndRectangle) {
  using Kind = ConvexSet::Kind;
  const SupportFeature square = a_rectangle(2, 2);
  // Across the corner, diagonally; through the corner; beyond it.
  EXPECT_NEAR(shared(a_segment(1, 1, 5, -5), square).perimeter(), 2 * std::sqrt(2), 1e-14);
  EXPECT_EQ(shared(a_segment(2, 2, 5, -5), square).kind(), Kind::point);
  EXPECT_EQ(middle_shared(a_segment(2, 2, 5, -5), square), Vec2(2, 2));
  EXPECT_EQ(shared(a_segment(3, 2, 5, -5), square).kind(), Kind::point);
  EXPECT_EQ(shared(a_segment(0, 0, 1, 0), square).perimeter(), 2);
  EXPECT_EQ(middle_shared(a_segment(3, 0, 1, 0), square), Vec2(2, 0));
}

}  // namespace
}  // namespace touchstone::oracle
