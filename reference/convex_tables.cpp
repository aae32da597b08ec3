#include "convex_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>

namespace touchstone {
namespace {

/// A number as the sum of two doubles: twice the digits (Dekker, "A floating-point technique for
/// extending the available precision", 1971).
struct Twofold {
  double high = 0, low = 0;
};
Twofold sum_of(double x, double y) {
  const double high = x + y, part = high - x;
  return {high, (x - (high - part)) + (y - part)};
}
Twofold operator+(const Twofold& x, const Twofold& y) {
  const Twofold sum = sum_of(x.high, y.high);
  return sum_of(sum.high, sum.low + (x.low + y.low));
}
Twofold operator-(const Twofold& x) { return {-x.high, -x.low}; }
Twofold operator*(const Twofold& x, const Twofold& y) {
  const double high = x.high * y.high;
  return sum_of(high, std::fma(x.high, y.high, -high) + (x.high * y.low + x.low * y.high));
}
using TwofoldVector = std::array<Twofold, 3>;

Vec3 times_power_of_two(const Vec3& v, int exponent) {
  return {std::ldexp(v.x(), exponent), std::ldexp(v.y(), exponent), std::ldexp(v.z(), exponent)};
}
/// The power of two that makes the largest component about one; of a zero vector 0.
int exponent_to_one(const Vec3& v) {
  const double largest = v.cwiseAbs().maxCoeff();
  return largest > 0 ? -std::ilogb(largest) : 0;
}
/// However long or short it is.
Vec3 unit_along(const Vec3& v) { return times_power_of_two(v, exponent_to_one(v)).normalized(); }

/// What halves lengths if their differences may overflow: always halved, the least would vanish.
double room_for_differences(const std::vector<Vec3>& points) {
  constexpr double limit = std::numeric_limits<double>::max() / 2;
  const bool are_small = std::all_of(
      points.begin(), points.end(), [](const Vec3& p) { return p.cwiseAbs().maxCoeff() <= limit; });
  return are_small ? 1 : 0.5;
}

/// The outward unit normal of a plane polygon.
Vec3 normal_of(const std::vector<Vec3>& vertices, const Convex::Face& face, double part) {
  std::vector<int> corners = face.vertices;
  // Seen from the shortest edge: from afar the product of nearly equal arms would lose it.
  std::size_t shortest = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 edge =
        part * vertices[corners[(i + 1) % corners.size()]] - part * vertices[corners[i]];
    const double length = edge.cwiseAbs().maxCoeff();
    if (length < least) least = length, shortest = i;
  }
  std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(shortest),
              corners.end());
  const Vec3& first = vertices[corners.front()];
  Vec3 longest = Vec3::Zero();
  for (const int i : corners) {
    const Vec3 arm = part * vertices[i] - part * first;
    if (arm.cwiseAbs().maxCoeff() > longest.cwiseAbs().maxCoeff()) longest = arm;
  }
  constexpr int room = 500;  // half of what doubles have: no product of a sliver's arms underflows
  const int exponent = exponent_to_one(longest) + room;
  const auto arm = [&](int corner) {
    TwofoldVector result;
    for (int k = 0; k < 3; ++k) {
      const Twofold x = sum_of(part * vertices[corner][k], -part * first[k]);
      result[k] = {std::ldexp(x.high, exponent), std::ldexp(x.low, exponent)};
    }
    return result;
  };
  TwofoldVector area;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const TwofoldVector p = arm(corners[i - 1]), q = arm(corners[i]);
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      area[k] = area[k] + (p[a] * q[b] + -(p[b] * q[a]));
    }
  }
  const Vec3 normal(area[0].high, area[1].high, area[2].high);
  if (normal.cwiseAbs().maxCoeff() > 0) return unit_along(normal);
  // Nothing is left of so thin a face, and any normal across it is as good.
  return unit_along(longest).unitOrthogonal();
}

template <class Item>
ConvexTables::Lists<Item> lists_of(const std::vector<std::vector<Item>>& owners) {
  ConvexTables::Lists<Item> lists;
  for (const auto& items : owners) {
    lists.first.push_back(static_cast<int>(lists.items.size()));
    lists.items.insert(lists.items.end(), items.begin(), items.end());
  }
  lists.first.push_back(static_cast<int>(lists.items.size()));
  return lists;
}

/// Makes facets of faces. Starts at each face that is not yet in one, the largest first, and adds
/// neighbours all of whose vertices are within `flat` of its plane, if they do not lean too far.
class FacetMaker {
 public:
  FacetMaker(const std::vector<Vec3>& vertices, const std::vector<Convex::Face>& faces,
             const ConvexTables& tables, double flat, double least_cosine)
      : vertices_(vertices),
        faces_(faces),
        tables_(tables),
        flat_(flat),
        least_cosine_(least_cosine),
        facet_(faces.size(), -1) {}

  std::vector<ConvexTables::Facet> make() {
    std::vector<int> order(faces_.size());
    std::vector<double> width(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      order[f] = static_cast<int>(f);
      for (const ConvexTables::FaceEdge& e : tables_.face_edges.of(order[f])) {
        width[f] = std::max(width[f], inside(static_cast<int>(f), e));
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](int f, int g) { return width[f] > width[g]; });
    std::vector<ConvexTables::Facet> facets;
    for (const int f : order) {
      if (facet_[f] >= 0) continue;
      members_ = {f};
      facet_[f] = static_cast<int>(facets.size());
      for (std::size_t i = 0; i < members_.size(); ++i) grow(members_[i], f);
      facets.push_back(outlined(f));
    }
    return facets;
  }

 private:
  /// How far a face extends from that edge.
  double inside(int face, const ConvexTables::FaceEdge& e) const {
    const ConvexTables::Edge& edge = tables_.edges[e.edge];
    const Vec3 inward =
        tables_.face_normal(face).cross(edge.left == face ? edge.along : -edge.along);
    double most = 0;
    for (const int v : faces_[face].vertices) {
      most = std::max(most, inward.dot(vertices_[v] - edge.from));
    }
    return most;
  }
  void grow(int member, int seed) {
    const Vec3 normal = tables_.face_normal(seed);
    for (const ConvexTables::FaceEdge& e : tables_.face_edges.of(member)) {
      if (facet_[e.other] >= 0 || !(normal.dot(tables_.face_normal(e.other)) > least_cosine_)) {
        continue;
      }
      const auto& corners = faces_[e.other].vertices;
      const bool is_flat = std::all_of(corners.begin(), corners.end(), [&](int v) {
        return std::abs(tables_.height(vertices_[v], seed)) <= flat_;
      });
      if (!is_flat) continue;
      facet_[e.other] = facet_[seed];
      members_.push_back(e.other);
    }
  }
  /// How far q lies to the right of the way from p to r, seen against the normal.
  double to_the_right(const Vec3& normal, int p, int q, int r) const {
    const Vec3 way = unit_along(vertices_[r] - vertices_[p]);
    return way.cross(normal).dot(vertices_[q] - vertices_[p]);
  }
  bool turns_left_everywhere(const std::vector<int>& corners, const Vec3& normal) const {
    const std::size_t count = corners.size();
    for (std::size_t i = 0; i < count; ++i) {
      const int p = corners[i], q = corners[(i + 1) % count], r = corners[(i + 2) % count];
      if (to_the_right(normal, p, q, r) < -flat_) return false;
    }
    return true;
  }
  /// Without the vertices that are hardly off an edge.
  std::vector<int> straightened(const std::vector<int>& corners, const Vec3& normal) const {
    const std::size_t count = corners.size();
    const auto corner = [&](std::size_t i) { return corners[i % count]; };
    const auto sharpness = [&](std::size_t i) {
      return to_the_right(normal, corner(i + count - 1), corner(i), corner(i + 1));
    };
    std::size_t last = 0;
    for (std::size_t i = 1; i < count; ++i) {
      if (sharpness(i) > sharpness(last)) last = i;
    }
    std::vector<int> kept = {corner(last)};
    for (std::size_t i = last + 1, end = last + count; i < end; ++i) {
      for (std::size_t k = last + 1; k <= i; ++k) {
        if (std::abs(to_the_right(normal, corner(last), corner(k), corner(i + 1))) <= flat_)
          continue;
        last = i;
        kept.push_back(corner(last));
        break;
      }
    }
    return kept;
  }
  /// The members' outline; where that is no single one, or not convex, the first face alone.
  ConvexTables::Facet outlined(int seed) {
    std::map<int, int> next;
    bool is_single = true;
    for (const int f : members_) {
      for (const ConvexTables::FaceEdge& e : tables_.face_edges.of(f)) {
        if (facet_[e.other] == facet_[seed]) continue;
        const ConvexTables::Edge& edge = tables_.edges[e.edge];
        const bool is_left = edge.left == f;
        const int from = edge.vertices[is_left ? 0 : 1], to = edge.vertices[is_left ? 1 : 0];
        is_single = next.emplace(from, to).second && is_single;
      }
    }
    ConvexTables::Facet facet;
    int at = next.empty() ? 0 : next.begin()->first;
    for (std::size_t i = 0; is_single && i < next.size(); ++i) {
      facet.corners.push_back(at);
      at = next.at(at);  // as many edges lead to a vertex as from it
      is_single = (at == facet.corners.front()) == (i + 1 == next.size());
    }
    facet.normal = tables_.face_normal(seed);
    facet.offset = tables_.support(facet.normal);
    if (is_single && facet.corners.size() > 3) {
      const std::vector<int> corners = straightened(facet.corners, facet.normal);
      if (corners.size() >= 3) facet.corners = corners;
    }
    if (!is_single || facet.corners.size() < 3 ||
        !turns_left_everywhere(facet.corners, facet.normal)) {
      for (const int f : members_) {
        if (f != seed) facet_[f] = -1;
      }
      members_ = {seed};
      facet.corners = faces_[seed].vertices;
    }
    facet.faces = members_;
    return facet;
  }

  const std::vector<Vec3>& vertices_;
  const std::vector<Convex::Face>& faces_;
  const ConvexTables& tables_;
  double flat_, least_cosine_;
  std::vector<int> facet_, members_;
};

}  // namespace

ConvexTables::ConvexTables(const std::vector<Vec3>& points, const std::vector<Convex::Face>& given,
                           const std::vector<Convex::Edge>& given_edges)
    : vertices((points.size() + 3) / 4),
      faces((given.size() + 3) / 4),
      places(points),
      face_count(static_cast<int>(given.size())),
      face_middles(given.size()) {
  for (std::size_t i = 0; i < 4 * vertices.size(); ++i) {
    const Vec3& v = points[std::min(i, points.size() - 1)];
    Points& four = vertices[i / 4];
    four.x[i % 4] = v.x(), four.y[i % 4] = v.y(), four.z[i % 4] = v.z();
  }
  const double part = room_for_differences(points);
  for (std::size_t i = 0; i < 4 * faces.size(); ++i) {
    if (i < given.size()) face_normals.push_back(normal_of(points, given[i], part));
    const Vec3& n = face_normals.back();
    Points& four = faces[i / 4].normal;
    four.x[i % 4] = n.x(), four.y[i % 4] = n.y(), four.z[i % 4] = n.z();
  }
  std::vector<std::vector<FaceEdge>> of_face(given.size());
  std::vector<std::vector<int>> edges_at(points.size()), facets_at(points.size());
  std::vector<std::vector<int>> flats_at(points.size());
  for (const Convex::Edge& e : given_edges) {
    const Vec3 along = unit_along(part * points[e.vertices[1]] - part * points[e.vertices[0]]);
    const Vec3 left = face_normal(e.faces[0]), right = face_normal(e.faces[1]);
    const Vec3 middle = (left + right + along.cross(left - right)).normalized();
    const int index = static_cast<int>(edges.size());
    edges.push_back({Vec3::Zero(), along, middle, 0, 0, e.vertices, e.faces[0], e.faces[1]});
    of_face[e.faces[0]].push_back({index, e.faces[1], along.cross(left)});
    of_face[e.faces[1]].push_back({index, e.faces[0], right.cross(along)});
    for (const int v : e.vertices) edges_at[v].push_back(index);
  }
  face_edges = lists_of(of_face);
  vertex_edges = lists_of(edges_at);
  measure();
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  facets = FacetMaker(points, given, *this, rounding * far, 0).make();
  // At all vertices of its faces, for one that is no corner may be the farthest along a normal.
  const auto list = [&given](std::vector<std::vector<int>>& at, const Facet& facet, int index) {
    for (const int face : facet.faces) {
      for (const int v : given[face].vertices) {
        if (at[v].empty() || at[v].back() != index) at[v].push_back(index);
      }
    }
  };
  std::vector<int> plane_facet(given.size());  // of each face
  for (std::size_t f = 0; f < facets.size(); ++f) {
    for (const int face : facets[f].faces) plane_facet[face] = static_cast<int>(f);
    list(facets_at, facets[f], static_cast<int>(f));
  }
  constexpr double thin_leans = 0.5;  // a face that is hardly off may lean as much, if it is thin
  for (Facet& flat : FacetMaker(points, given, *this, rough_part * far, thin_leans).make()) {
    const int as_plane = plane_facet[flat.faces.front()];
    const std::size_t plane_count = facets[static_cast<std::size_t>(as_plane)].faces.size();
    flat.is_rough = flat.faces.size() > plane_count;
    const int index = flat.is_rough ? static_cast<int>(facets.size()) : as_plane;
    list(flats_at, flat, index);
    if (flat.is_rough) facets.push_back(std::move(flat));
  }
  vertex_facets = lists_of(facets_at);
  vertex_flats = lists_of(flats_at);
}

void ConvexTables::measure() {
  far = 0;
  for (const Points& p : vertices)
    far = std::max(far, (p.x.abs() + p.y.abs() + p.z.abs()).maxCoeff());
  for (int f = 0; f < 4 * static_cast<int>(faces.size()); ++f) {
    faces[f / 4].offset[f % 4] = support(face_normal(std::min(f, face_count - 1)));
  }
  for (Edge& e : edges) {
    e.from = vertex(e.vertices[0]);
    e.length = (vertex(e.vertices[1]) - e.from).dot(e.along);
    e.reach = support(e.middle);
  }
  for (Facet& f : facets) f.offset = support(f.normal);
  for (int f = 0; f < face_count; ++f) {
    // Its edges' vertices, each of which it has twice.
    const auto of_face = face_edges.of(f);
    const double part = 0.5 / static_cast<double>(of_face.size());
    Vec3& middle = face_middles[f];
    middle = Vec3::Zero();
    for (const FaceEdge& e : of_face) {
      for (const int v : edges[e.edge].vertices) middle += part * vertex(v);
    }
  }
}

ConvexTables ConvexTables::scaled(int exponent) const {
  ConvexTables result = *this;
  const auto scale = [exponent](double x) { return std::ldexp(x, exponent); };
  for (Points& p : result.vertices) {
    p.x = p.x.unaryExpr(scale), p.y = p.y.unaryExpr(scale), p.z = p.z.unaryExpr(scale);
  }
  for (Vec3& v : result.places) v = times_power_of_two(v, exponent);
  result.measure();
  return result;
}

}  // namespace touchstone
