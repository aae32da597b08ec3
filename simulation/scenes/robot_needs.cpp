#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "simulation/scenes/exact_motion.hpp"
#include "simulation/scenes/robot_file.hpp"

namespace touchstone {
void add_robot_needs(SceneFile& file, const ExactMotion& exact) {
  const std::vector<Body>& bodies = file.scene.bodies;
  // Which of four equal wheels carries more is left to chance.
  std::map<std::string, double> depth_of_shape;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    double& depth = depth_of_shape[shape_text(bodies[i].shape)];
    depth = std::max(depth, exact.depths[i]);
  }
  std::set<int> held;             // bodies that a joint holds to another one
  std::map<int, double> carried;  // by body: largest half width of those that joints hold to it
  for (const Joint& joint : file.scene.joints) {
    held.insert(joint.a);
    double& largest = carried[joint.b];
    largest = std::max(largest, largest_half_extent(bodies[joint.a].shape));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    if (body.fixed) continue;
    const int index = static_cast<int>(i);
    constexpr double share_of_width = 0.01, of_exact = 2;
    if (exact.depths[i] > 0) {
      const double depth = depth_of_shape.at(shape_text(body.shape));
      const double width = 2 * smallest_half_extent(body.shape);
      file.needs.push_back(
          penetration_need(index, readable_limit(of_exact * depth + share_of_width * width)));
    }
    if (held.contains(index)) continue;
    // A base whose shapes are not read, say, is where its wheels carry it; without those nothing
    // could be wrong with the end of a flight.
    if (!body.collides && !carried.contains(index)) continue;
    constexpr double share_of_way = 0.02, share_of_size = 0.05;
    const double half_width = body.collides ? largest_half_extent(body.shape) : carried.at(index);
    const double size = 2 * half_width;
    file.needs.push_back(
        ends_near_need(index, readable_limit(share_of_way * exact.ways[i] + share_of_size * size)));
    constexpr double max_tilt = 1;  // degrees: a body's ends move by 1% of its size
    const bool has_tilt = body.collides && !std::holds_alternative<Sphere>(body.shape);
    if (has_tilt) file.needs.push_back(ends_tilted_need(index, max_tilt));
  }
}

}  // namespace touchstone
