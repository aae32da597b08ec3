// POV-Ray's coordinate system is left-handed. A camera with reversed `right` makes it right-handed
// with z up, so that poses are written unchanged.
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "properties/files/disk.hpp"
#include "simulation/scenes/scene_file.hpp"

namespace touchstone {
namespace {

std::string povray_vector(const Vec3& v) {
  return fmt::format("<{:.9g},{:.9g},{:.9g}>", v.x(), v.y(), v.z());
}

std::string view(const Camera& camera) {
  const double reach = (camera.position - camera.look_at).norm();
  const Vec3 lamp = camera.look_at + reach * Vec3(0.4, -0.9, 1.6);
  return fmt::format(
      "#version 3.7;\n"
      "global_settings {{ assumed_gamma 1 }}\n"
      "camera {{\n"
      "  sky z right -x*image_width/image_height up z\n"
      "  location {} look_at {} angle 46\n"
      "}}\n"
      "light_source {{ {} rgb 1 area_light x*{:.6g}, y*{:.6g}, 4, 4 adaptive 1 jitter }}\n"
      "light_source {{ {} rgb 0.35 shadowless }}\n"
      "background {{ rgb <0.78,0.84,0.9> }}\n"
      "#macro Striped(Colour)\n"
      "  texture {{\n"
      "    pigment {{ radial frequency 4 color_map {{ [0.5 rgb Colour] [0.5 rgb 0.85] }} rotate "
      "x*90 }}\n"
      "    finish {{ ambient 0.1 diffuse 0.7 specular 0.25 roughness 0.03 }}\n"
      "  }}\n"
      "#end\n"
      "#macro Plain(Colour)\n"
      "  texture {{ pigment {{ rgb Colour }} finish {{ ambient 0.12 diffuse 0.7 }} }}\n"
      "#end\n"
      "#include concat(\"frame-\", str(max(1, frame_number), -5, 0), \".inc\")\n",
      povray_vector(camera.position), povray_vector(camera.look_at), povray_vector(lamp), reach / 4,
      reach / 4, povray_vector(camera.position));
}

/// POV-Ray object of a shape in the body's frame, with its texture, without the closing brace.
struct Object {
  bool fixed;

  const char* plain() const { return fixed ? "Plain(<0.5,0.52,0.55>)" : "Plain(<0.7,0.55,0.3>)"; }

  std::string operator()(const Cylinder& s) const {
    return fmt::format("cylinder {{ -z*{0:.9g}, z*{0:.9g}, {1:.9g} Striped(<0.08,0.22,0.5>)",
                       s.half_length(), s.radius());
  }
  std::string operator()(const Capsule& s) const {
    return fmt::format(
        "merge {{ cylinder {{ -z*{0:.9g}, z*{0:.9g}, {1:.9g} }} sphere {{ -z*{0:.9g}, {1:.9g} }} "
        "sphere {{ z*{0:.9g}, {1:.9g} }} Striped(<0.7,0.3,0.05>)",
        s.half_length(), s.radius());
  }
  std::string operator()(const Sphere& s) const {
    return fmt::format("sphere {{ 0, {:.9g} Striped(<0.35,0.2,0.5>)", s.radius());
  }
  std::string operator()(const Box& s) const {
    return fmt::format("box {{ {}, {} {}", povray_vector(-s.half_extents()),
                       povray_vector(s.half_extents()), plain());
  }
  std::string operator()(const Convex& s) const {
    std::string text = "mesh { ";
    for (const Convex::Face& face : s.faces()) {
      const auto corner = [&](std::size_t i) {
        return povray_vector(s.vertices()[face.vertices[i]]);
      };
      for (std::size_t i = 2; i < face.vertices.size(); ++i) {
        text += fmt::format("triangle {{ {}, {}, {} }} ", corner(0), corner(i - 1), corner(i));
      }
    }
    return text + plain();
  }
  std::string operator()(const Plane& s) const {
    return fmt::format("plane {{ {}, {:.9g} Plain(<0.62,0.64,0.6>)", povray_vector(s.unit_normal()),
                       s.unit_displacement());
  }
};

/// Transformation of a pose, and the closing brace. POV-Ray's rows are the images of the axes.
std::string placed(const Pose& pose) {
  std::string numbers;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 image = pose.rotation().col(axis);
    numbers += fmt::format("{:.9g},{:.9g},{:.9g}, ", image.x(), image.y(), image.z());
  }
  const Vec3& p = pose.position();
  return fmt::format("matrix <{}{:.9g},{:.9g},{:.9g}> }}", numbers, p.x(), p.y(), p.z());
}

}  // namespace

int write_povray(const SceneFile& file, const Trajectory& run, double every,
                 const std::filesystem::path& folder) {
  const auto stride =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(every / run.step)));
  remove_older(folder, "frame-", ".inc");
  write_file(folder / "scene.pov", view(file.camera), "--povray");
  int count = 0;
  for (std::size_t i = 0; i < run.frames.size(); i += stride) {
    std::string text =
        fmt::format("// {} at {:.4f} s\n", file.name, run.step * static_cast<double>(i));
    for (std::size_t b = 0; b < file.scene.bodies.size(); ++b) {
      const Body& body = file.scene.bodies[b];
      text +=
          std::visit(Object{body.fixed}, body.shape) + ' ' + placed(run.frames[i][b].pose) + '\n';
    }
    write_file(folder / fmt::format("frame-{:05}.inc", ++count), text, "--povray");
  }
  write_file(folder / "scene.ini",
             fmt::format("Input_File_Name=scene.pov\nOutput_File_Type=N\nWidth=800\nHeight=600\n"
                         "Antialias=On\nQuality=9\nDisplay=Off\nInitial_Frame=1\nFinal_Frame={}\n",
                         count),
             "--povray");
  return count;
}

}  // namespace touchstone
