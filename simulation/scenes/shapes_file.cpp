#include "simulation/scenes/shapes_file.hpp"

#include <algorithm>
#include <exception>
#include <fmt/format.h>
#include <string_view>

#include "properties/files/error_text.hpp"
#include "properties/files/read_file.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// How deeply elements are nested, where they are closed; what is not closed counts as open.
std::size_t depth_of(std::string_view xml) {
  std::size_t depth = 0, max_depth = 0;
  for (std::size_t at = xml.find('<'); at != xml.npos; at = xml.find('<', at + 1)) {
    const std::string_view tag = xml.substr(at);
    if (tag.starts_with("<!--")) {
      at = std::min(xml.find("-->", at), xml.size());
    } else if (tag.starts_with("</")) {
      depth -= depth > 0 ? 1 : 0;
    } else if (!tag.starts_with("<!") && !tag.starts_with("<?")) {
      max_depth = std::max(max_depth, ++depth);
      const std::size_t end = xml.find('>', at);
      if (end != xml.npos && xml[end - 1] == '/') --depth;
    }
  }
  return max_depth;
}

}  // namespace

std::string read_xml(const std::filesystem::path& file) {
  std::string text = read_file(file, "scene");
  constexpr std::size_t max_depth = 100;
  if (text.find('\0') != text.npos) {
    throw InvalidInput("scene", '"' + file.string() + '"', "must be text: it holds a NUL byte");
  }
  if (depth_of(text) > max_depth) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       fmt::format("must have elements at most {} levels deep", max_depth));
  }
  return text;
}

bool is_shapes_file(const std::filesystem::path& file) {
  const auto ending = file.extension();
  return ending == ".urdf" || ending == ".sdf" || ending == ".world";
}

ShapesFile read_shapes(const std::filesystem::path& file) {
  ShapesFile shapes;
  try {
    shapes = file.extension() == ".urdf" ? read_urdf(file) : read_sdf(file);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::exception& e) {  // of the libraries
    constexpr std::size_t max_reason = 200;
    throw InvalidInput(
        "scene", '"' + file.string() + '"',
        "must be a URDF or SDF file; its reader says: " + printable(e.what(), max_reason));
  }
  constexpr std::size_t max_shapes = 2000;  // each is held against each other one
  if (shapes.shapes.size() > max_shapes) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       fmt::format("must have at most {} collision shapes, not {}", max_shapes,
                                   shapes.shapes.size()));
  }
  return shapes;
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
