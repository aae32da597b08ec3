#include "simulation/scenes/mesh.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

#include "oracle/hull.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

bool comes_before(const Vec3& p, const Vec3& q) {
  return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end());
}

/// By point: the number of its place, the same for equal ones.
std::vector<int> places_of(const std::vector<Vec3>& points) {
  std::vector<int> order(points.size()), place(points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto before = [&](int i, int j) { return comes_before(points[i], points[j]); };
  std::sort(order.begin(), order.end(), before);
  for (std::size_t i = 0, count = 0; i < order.size(); ++i) {
    if (i > 0 && before(order[i - 1], order[i])) ++count;
    place[order[i]] = static_cast<int>(count);
  }
  return place;
}

/// Is it the boundary of something? Then as many triangles run along each edge one way as the
/// other.
bool is_closed(const Mesh& mesh) {
  const std::vector<int> place = places_of(mesh.points);
  std::vector<std::pair<std::pair<int, int>, int>> edges;  // with the way: 1 or −1
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int from = place[triangle[k]], to = place[triangle[(k + 1) % 3]];
      edges.push_back({std::minmax(from, to), from < to ? 1 : from > to ? -1 : 0});
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    const auto& edge = edges[i].first;
    int sum = 0;
    for (; i < edges.size() && edges[i].first == edge; ++i) sum += edges[i].second;
    if (sum != 0) return false;
  }
  return true;
}

/// Sum of the tetrahedra that the triangles form with a point.
double enclosed_volume(const Mesh& mesh, const Vec3& from) {
  double volume = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3 a = mesh.points[i] - from, b = mesh.points[j] - from, c = mesh.points[k] - from;
    volume += a.dot(b.cross(c)) / 6;
  }
  return std::abs(volume);
}

/// "arm.dae: its hull is 38% larger than the mesh"; empty if the mesh is its own hull.
std::string note_of(const Mesh& mesh, const Vec3& middle, const std::string& name,
                    const Convex& hull) {
  constexpr double seen = 0.005;  // half of a per cent
  const double volume = enclosed_volume(mesh, middle);
  // Parts that overlap count twice: then it is not known, either.
  const double added = inertia(hull, 1).inertia.mass / volume - 1;
  if (!is_closed(mesh) || !(volume > 0) || added < -seen) {
    return name +
           ": taken as its hull, and nobody can say how much larger that is: the mesh is "
           "not closed, or its parts overlap";
  }
  if (added < seen) return "";
  return fmt::format("{}: its hull is {:.0f}% larger than the mesh", name, 100 * added);
}

}  // namespace

Mesh named_mesh(const std::string& uri, const Vec3& scale, const std::filesystem::path& file,
                const Folders& folders) {
  if (!scale.allFinite() || (scale.array() == 0).any()) {
    throw InvalidInput("mesh.scale", fmt::format("\"{} {} {}\"", scale.x(), scale.y(), scale.z()),
                       "must be three finite numbers, none of them zero");
  }
  const std::string shown = '"' + printable(uri, 200) + '"';
  if (uri.starts_with("http://") || uri.starts_with("https://")) {
    throw InvalidInput("mesh", shown,
                       "must be on this machine: download it, and name its folder with "
                       "--model-path");
  }
  const bool is_relative = uri.find("://") == uri.npos;
  std::filesystem::path found = is_relative ? file.parent_path() / uri : std::filesystem::path();
  std::error_code error;
  if (!is_relative || !std::filesystem::exists(found, error)) found = find_resource(uri, folders);
  if (found.empty()) {
    throw InvalidInput("mesh", shown,
                       "must name a file in a folder of --model-path, ROS_PACKAGE_PATH, "
                       "AMENT_PREFIX_PATH or GZ_SIM_RESOURCE_PATH, or beside the file; or leave "
                       "this collision out");
  }
  Mesh mesh = read_mesh(found);
  for (Vec3& p : mesh.points) p = p.cwiseProduct(scale);
  return mesh;
}

LinkShape hull_of(const Mesh& mesh, const std::string& mesh_name, const std::string& shape_name,
                  const Pose& X_WM, RobotFile& robot) {
  std::vector<Vec3> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const int i : triangle) corners.push_back(mesh.points[i]);
  }
  Vec3 low = corners.front(), high = low;
  for (const Vec3& p : corners) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec3 middle = low / 2 + high / 2;
  std::sort(corners.begin(), corners.end(), comes_before);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (Vec3& p : corners) p -= middle;
  try {
    const Convex hull = oracle::convex_hull(corners);
    const std::string note = note_of(mesh, middle, mesh_name, hull);
    if (!note.empty() && std::ranges::count(robot.ignored, note) == 0) {
      robot.ignored.push_back(note);
    }
    return {shape_name, hull, Pose(X_WM.position() + X_WM.rotation() * middle, X_WM.orientation())};
  } catch (const InvalidInput& e) {
    throw InvalidInput("mesh", fmt::format("\"{}\" ({})", mesh_name, e.value()),
                       e.remedy() + ": simplify the mesh, or put shapes in its place");
  }
}

}  // namespace touchstone
