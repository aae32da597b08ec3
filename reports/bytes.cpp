#include "reports/bytes.hpp"

#include <stdexcept>
#include <variant>

namespace touchstone {
namespace {

constexpr int base = 62;  // the most compact one of GMP

void put(ByteWriter& out, const Pose& pose) {
  const Eigen::Quaterniond& q = pose.orientation();
  out.put(pose.position());
  for (const double x : {q.w(), q.x(), q.y(), q.z()}) out.put(x);
}

Pose get_pose(ByteReader& in) {
  const Vec3 position = in.get_vector();
  const double w = in.get<double>(), x = in.get<double>(), y = in.get<double>();
  return Pose(position, Eigen::Quaterniond(w, x, y, in.get<double>()));
}

void put(ByteWriter& out, const Cylinder& c) {
  out.put(c.radius());
  out.put(c.half_length());
}
void put(ByteWriter& out, const Plane& p) {
  out.put(p.normal());
  out.put(p.displacement());
}
void put(ByteWriter& out, const Sphere& s) { out.put(s.radius()); }
void put(ByteWriter& out, const Capsule& c) {
  out.put(c.radius());
  out.put(c.half_length());
}
void put(ByteWriter& out, const Box& b) { out.put(b.half_extents()); }

template <class Round>
Round get_round(ByteReader& in) {
  const double radius = in.get<double>();
  return Round(radius, in.get<double>());
}

/// `index`: in the variant.
Shape get_shape(ByteReader& in, std::size_t index) {
  static_assert(std::variant_size_v<Shape> == 5);
  if (index == Shape(Sphere(1)).index()) return Sphere(in.get<double>());
  if (index == Shape(Capsule(1, 1)).index()) return get_round<Capsule>(in);
  if (index == Shape(Cylinder(1, 1)).index()) return get_round<Cylinder>(in);
  const Vec3 v = in.get_vector();
  if (index == Shape(Box(Vec3::Ones())).index()) return Box(v);
  return Plane(v, in.get<double>());
}

}  // namespace

void ByteWriter::put(const Configuration& c) {
  touchstone::put(*this, c.a);
  touchstone::put(*this, c.pose_a);
  put(c.b.index());
  std::visit([&](const auto& shape) { touchstone::put(*this, shape); }, c.b);
  touchstone::put(*this, c.pose_b);
}

Configuration ByteReader::get_configuration() {
  const Cylinder a = get_round<Cylinder>(*this);
  const Pose pose_a = get_pose(*this);
  const Shape b = get_shape(*this, get<std::size_t>());
  return {a, pose_a, b, get_pose(*this)};
}

void ByteWriter::put(const oracle::Truth& truth) {
  put(truth.signed_distance.lo.get_str(base));
  put(truth.signed_distance.hi.get_str(base));
  put(truth.ties);
  put(truth.normals.size());
  for (const oracle::OptimalNormal& normal : truth.normals) {
    put(normal.n);
    put(normal.to_a);
    put(normal.to_b);
  }
  put(truth.families.size());
  for (const oracle::NormalFamily& family : truth.families) {
    put(family.kind);
    put(family.axis);
    put(family.ends.size());
    for (const Vec3& end : family.ends) put(end);
  }
}

oracle::Truth ByteReader::get_truth() {
  oracle::Truth truth;
  truth.signed_distance.lo = mpq_class(get_text(), base);
  truth.signed_distance.hi = mpq_class(get_text(), base);
  truth.ties = get<oracle::Ties>();
  truth.normals.resize(get<std::size_t>());
  for (oracle::OptimalNormal& normal : truth.normals) {
    normal.n = get_vector();
    normal.to_a = get<oracle::Alignment>();
    normal.to_b = get<std::array<oracle::Alignment, 3>>();
  }
  truth.families.resize(get<std::size_t>());
  for (oracle::NormalFamily& family : truth.families) {
    family.kind = get<oracle::NormalFamily::Kind>();
    family.axis = get_vector();
    family.ends.resize(get<std::size_t>());
    for (Vec3& end : family.ends) end = get_vector();
  }
  return truth;
}

void ByteWriter::put(const Answer& answer) {
  put(static_cast<const ts_answer&>(answer));
  put(answer.reason);
  put(answer.model_distance);
}

Answer ByteReader::get_answer() {
  Answer answer{get<ts_answer>(), {}, {}};
  answer.reason = get_text();
  answer.model_distance = get<std::optional<double>>();
  return answer;
}

std::string ByteReader::get_text() {
  std::string text(get<std::size_t>(), '\0');
  copy(text.data(), text.size());
  return text;
}

Vec3 ByteReader::get_vector() {
  const double x = get<double>(), y = get<double>();
  return Vec3(x, y, get<double>());
}

void ByteReader::copy(void* to, std::size_t size) {
  if (size > rest_.size()) throw std::logic_error("bytes of a worker end too early");
  if (size > 0) std::memcpy(to, rest_.data(), size);
  rest_.remove_prefix(size);
}

}  // namespace touchstone
