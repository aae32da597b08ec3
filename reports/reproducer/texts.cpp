#include "reports/reproducer/texts.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>
#include <utility>
#include <vector>

#include "candidates/candidates.hpp"
#include "oracle/judge/cast_score.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "properties/files/answer_json.hpp"
#include "reports/replay.hpp"

namespace touchstone {
namespace {

using Quaternion = std::array<double, 4>;  // w, x, y, z
using Vector = std::array<double, 3>;

/// Which quaternion turns an engine's axis into our z axis.
const Quaternion y_to_z = {M_SQRT1_2, M_SQRT1_2, 0, 0}, x_to_z = {M_SQRT1_2, 0, -M_SQRT1_2, 0};

// As in candidates/npm/packages.mjs, operation for operation, so that engines get the same bits.

Quaternion multiply(const double* p, const Quaternion& q) {
  const auto [w, x, y, z] = q;
  return {p[0] * w - p[1] * x - p[2] * y - p[3] * z, p[0] * x + p[1] * w + p[2] * z - p[3] * y,
          p[0] * y - p[1] * z + p[2] * w + p[3] * x, p[0] * z + p[1] * y - p[2] * x + p[3] * w};
}

Vector rotate(const double* q, const double* v) {
  const double w = q[0], x = q[1], y = q[2], z = q[3], a = v[0], b = v[1], c = v[2];
  const double s = 2 * (y * c - z * b), t = 2 * (z * a - x * c), u = 2 * (x * b - y * a);
  return {a + w * s + y * u - z * t, b + w * t + z * s - x * u, c + w * u + x * t - y * s};
}

/// A rotation that turns one unit vector into another.
Quaternion turn(const Vector& from, const double* to) {
  const auto [a, b, c] = from;
  const double w = 1 + a * to[0] + b * to[1] + c * to[2];
  Quaternion q = {w, b * to[2] - c * to[1], c * to[0] - a * to[2], a * to[1] - b * to[0]};
  if (w < 1e-9) {  // opposite: half a turn about anything across
    q = std::abs(a) < 0.8 ? Quaternion{0, 0, c, -b} : Quaternion{0, -c, 0, a};
  }
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& x : q) x /= length;
  return q;
}

/// The shortest decimals that give the same number; zero keeps its sign in Python, too.
std::string decimal(double x) { return x == 0 && std::signbit(x) ? "-0.0" : fmt::format("{}", x); }

std::string single(double x) {
  const std::string text = fmt::format("{}", static_cast<float>(x));
  return text + (text.find_first_of(".e") == text.npos ? ".0f" : "f");
}

std::string hexadecimal(double x) { return fmt::format("{:a}", x); }

class Writer {
 public:
  explicit Writer(NumberStyle numbers) : numbers_(numbers) {}

  /// As the language writes it; for C++ with floats also, as "name_float", and for MJCF with spaces
  /// alone, as "name_xml".
  void put(const std::string& name, std::span<const double> values) {
    std::vector<std::string> own, floats, decimals;
    for (const double x : values) {
      own.push_back(numbers_ == NumberStyle::hexadecimal ? hexadecimal(x) : decimal(x));
      floats.push_back(single(x));
      decimals.push_back(decimal(x));
    }
    texts[name] = fmt::format("{}", fmt::join(own, ", "));
    texts[name + "_float"] = fmt::format("{}", fmt::join(floats, ", "));
    texts[name + "_xml"] = fmt::format("{}", fmt::join(decimals, " "));
  }
  void put(const std::string& name, double value) { put(name, {&value, 1}); }

  /// A rotation, x, y, z, w, as engines take it.
  void put_xyzw(const std::string& name, const Quaternion& q) {
    put(name, std::array{q[1], q[2], q[3], q[0]});
  }

  Texts texts;

 private:
  NumberStyle numbers_;
};

/// Where engines have their half-spaces: through the origin of a frame of their own.
void put_plane(Writer& writer, const ts_shape& plane, const ts_pose& pose) {
  const Vector up = rotate(pose.orientation, plane.size);
  Vector point;
  for (std::size_t i = 0; i < 3; ++i) point[i] = pose.position[i] + plane.size[3] * up[i];
  writer.put("plane_point", point);
  writer.put_xyzw("plane_along_x", multiply(pose.orientation, turn({1, 0, 0}, plane.size)));
  writer.put("plane_along_z", multiply(pose.orientation, turn({0, 0, 1}, plane.size)));
}

/// For C++: each vertex and each face in braces.
void put_convex(Writer& writer, const Convex& convex) {
  std::vector<std::string> vertices, faces;
  for (const Vec3& vertex : convex.vertices()) {
    writer.put("vertex_b", std::span(vertex.data(), 3));
    vertices.push_back('{' + writer.texts["vertex_b"] + '}');
  }
  for (const Convex::Face& face : convex.faces()) {
    faces.push_back(fmt::format("{{{}}}", fmt::join(face.vertices, ", ")));
  }
  writer.put("centre_b", std::span(convex.middle().data(), 3));
  writer.texts["vertices_b"] =
      fmt::format("{}", fmt::join(vertices, ",\n                               "));
  writer.texts["faces_b"] = fmt::format("{}", fmt::join(faces, ", "));
}

}  // namespace

Configuration as_asked(const Configuration& configuration) {
  Configuration result = configuration;
  for (Pose* pose : {&result.pose_a, &result.pose_b}) {
    *pose = Pose(pose->position(), pose->unit_orientation());
  }
  if (const auto* plane = std::get_if<Plane>(&configuration.b)) {
    result.b = Plane(plane->unit_normal(), plane->unit_displacement());
  }
  return result;
}

Texts question_texts(const Configuration& c, NumberStyle numbers) {
  const ts_shape a = to_ts_shape(c.a), b = to_ts_shape(c.b);
  const ts_pose pose_a = to_ts_pose(c.pose_a), pose_b = to_ts_pose(c.pose_b);
  Writer writer(numbers);
  writer.put("radius_a", a.size[0]);
  writer.put("half_length_a", a.size[1]);
  writer.put("radius_b", b.size[0]);
  writer.put("half_length_b", b.size[1]);
  writer.put("half_b", std::span(b.size, 3));
  writer.put("normal_b", std::span(b.size, 3));
  writer.put("displacement_b", b.size[3]);
  writer.put("constant_b", -b.size[3]);
  for (const auto& [body, pose] : {std::pair("a", pose_a), std::pair("b", pose_b)}) {
    const std::string name = body;
    const double* const q = pose.orientation;
    writer.put("position_" + name, pose.position);
    writer.put("orientation_" + name, pose.orientation);
    writer.put_xyzw("xyzw_" + name, {q[0], q[1], q[2], q[3]});
    writer.put_xyzw(name + "_along_y", multiply(q, y_to_z));
    writer.put_xyzw(name + "_along_x", multiply(q, x_to_z));
  }
  if (b.kind == TS_PLANE) put_plane(writer, b, pose_b);
  if (const auto* const convex = std::get_if<Convex>(&c.b)) put_convex(writer, *convex);
  std::string shape = shape_name(c.b);
  writer.texts["shape_b"] = shape;
  shape[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(shape[0])));
  writer.texts["Shape_b"] = shape;
  return writer.texts;
}

namespace {

/// The best normals, and what is in the middle of where the bodies meet along the first of them.
void put_best(Writer& writer, const Configuration& c, const oracle::Truth& truth,
              NumberStyle numbers) {
  const Vec3 n = truth.normals.front().n;
  const Vec3 middle = oracle::contact_patch(c, truth.normals.front()).centroid();
  std::vector<std::string> normals;
  for (const oracle::OptimalNormal& optimal : truth.normals) {
    writer.put("true_normal", std::span(optimal.n.data(), 3));
    const std::string& text = writer.texts["true_normal"];
    normals.push_back(numbers == NumberStyle::hexadecimal ? '{' + text + '}' : '[' + text + ']');
  }
  writer.texts["true_normals"] = fmt::format("{}", fmt::join(normals, ", "));
  writer.put("true_axis", std::array{-n.x(), -n.y(), -n.z()});
  writer.put("middle", std::span(middle.data(), 3));
}

void put_bar(Writer& writer, const Configuration& c, const Bar& bar) {
  writer.put("threshold", bar.threshold);
  writer.put("allowed", bar.tolerance * error_size(c, bar));
  const bool is_of_smaller = error_size(c, bar) == smaller_size(c);
  writer.texts["allowed_words"] =
      is_of_smaller ? fmt::format("{} of the smaller half extent of both bodies", bar.tolerance)
                    : fmt::format("{} of the largest length, for doubles place no body better",
                                  std::min(bar.tolerance, 1e-13));
}

/// The last part of a sweep that `holds`, on the way from one that does.
double last_that(const std::function<bool(double)>& holds, double yes, double no) {
  constexpr int halvings = 40;
  if (holds(no)) return no;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (yes + no) / 2;
    (holds(middle) ? yes : no) = middle;
  }
  return yes;
}

}  // namespace

Texts truth_texts(const Configuration& c, const oracle::Truth& truth, const Bar& bar,
                  NumberStyle numbers) {
  const auto [low, high] = decimals(truth.signed_distance);
  const double distance = nearest_to_middle(truth.signed_distance);
  Writer writer(numbers);
  writer.put("true_distance", distance);
  writer.put("true_depth", -distance);
  put_best(writer, c, truth, numbers);
  put_bar(writer, c, bar);
  writer.texts["truth_low"] = low;
  writer.texts["truth_high"] = high;
  return writer.texts;
}

Texts cast_texts(const Configuration& c, const Vec3& sweep, const oracle::FirstTouch& touch,
                 const Bar& bar, NumberStyle numbers) {
  using Status = oracle::FirstTouch::Status;
  const Sweep moves(sweep);
  const DistanceInTime distance(c, moves);
  const double allowed = bar.tolerance * error_size(c, bar);
  const double first = touch.fraction.hi.get_d();
  const auto [of_nearest, nearest] = distance.nearest(touch.status == Status::never ? 0 : first, 1);
  const double at = touch.status == Status::never ? of_nearest : first;
  // As score_cast judges: from where A is near enough until it has been too deep or leaves again,
  // which it cannot while it has moved by no more than is allowed.
  const auto is_near = [&](double t) { return distance.at(t) <= allowed; };
  const auto is_shallow = [&](double t) { return distance.at(t) >= -allowed; };
  double earliest = 1, latest = 0;
  if (is_near(at)) {
    earliest = last_that(is_near, at, 0);
    latest =
        nearest < -allowed ? last_that(is_shallow, first, of_nearest) : last_that(is_near, at, 1);
    latest = std::max(latest, std::min(1.0, at + allowed / sweep.stableNorm()));
  }
  Writer writer(numbers);
  writer.put("sweep", std::span(sweep.data(), 3));
  writer.put("true_fraction", at);
  writer.put("deepest", std::max(0.0, -nearest));
  writer.put("earliest", earliest);
  writer.put("latest", latest);
  put_bar(writer, c, bar);
  put_best(writer, swept(c, moves, at),
           touch.there ? *touch.there : oracle::truth_at(c, sweep, at, 1e-30), numbers);
  writer.texts["first_touch"] = first_touch_text(touch);
  return writer.texts;
}

Texts convex_radius_texts(const Configuration& c, const std::function<double(double)>& rule) {
  const auto smallest = [](const ts_shape& shape) {
    const int count = shape.kind == TS_BOX ? 3 : 2;
    return *std::min_element(shape.size, shape.size + count);
  };
  Writer writer(NumberStyle::decimal);
  writer.put("convex_radius_a", rule(smallest(to_ts_shape(c.a))));
  writer.put("convex_radius_b", rule(smallest(to_ts_shape(c.b))));
  return writer.texts;
}

}  // namespace touchstone
