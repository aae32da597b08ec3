#include "scenes/shapes_file.hpp"

#include <fmt/format.h>

namespace touchstone {

bool is_shapes_file(const std::filesystem::path& file) {
  const auto ending = file.extension();
  return ending == ".urdf" || ending == ".sdf" || ending == ".world";
}

ShapesFile read_shapes(const std::filesystem::path& file) {
  return file.extension() == ".urdf" ? read_urdf(file) : read_sdf(file);
}

SceneFile still_scene(const ShapesFile& shapes) {
  SceneFile file;
  file.name = shapes.name;
  file.scene.duration = 0;
  for (std::size_t i = 0; i < shapes.shapes.size(); ++i) {
    const PlacedShape& s = shapes.shapes[i];
    Body body{fmt::format("{} {}", i + 1, s.name), s.shape};
    body.pose = s.pose;
    body.fixed = true;
    file.scene.bodies.push_back(body);
  }
  check_scene(file.scene);
  file.camera = camera_for(file.scene);
  return file;
}

}  // namespace touchstone
