#include "properties/motions/perturbation.hpp"

#include <array>
#include <cmath>

#include "properties/draw.hpp"
#include "properties/identity.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

constexpr std::array<double, 17> powers = {1,     1e-1,  1e-2,  1e-3,  1e-4,  1e-5,
                                           1e-6,  1e-7,  1e-8,  1e-9,  1e-10, 1e-11,
                                           1e-12, 1e-13, 1e-14, 1e-15, 1e-16};

/// Separates these draws from those of identities.
constexpr std::uint64_t stream = 0x706572747572622eU;

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

}  // namespace

Decade Decade::parse(const char* field, std::string_view text) {
  for (int exponent = max; exponent >= min; --exponent) {
    if (text == Decade(exponent).name()) return Decade(exponent);
  }
  throw InvalidInput(field, quoted(text), "must be one of 1e-1, 1e-2, … 1e-16");
}

double Decade::value() const { return powers[static_cast<std::size_t>(-exponent_)]; }

std::string to_string(const Perturbation& p) {
  return p.amplitude.name() + "/" + std::to_string(p.seed) + "/" + std::to_string(p.number);
}

Perturbation parse_perturbation(std::string_view text) {
  const std::size_t first = text.find('/');
  const std::size_t second = first == text.npos ? first : text.find('/', first + 1);
  if (second == text.npos) {
    throw InvalidInput("perturbation", quoted(text),
                       "must read amplitude/seed/number, as in 1e-8/1/4");
  }
  return {Decade::parse("perturbation.amplitude", text.substr(0, first)),
          parse_number("perturbation.seed", text.substr(first + 1, second - first - 1)),
          parse_number("perturbation.number", text.substr(second + 1))};
}

Configuration moved(const Configuration& c, const Vec3& turn, const Vec3& by) {
  const Vec3& p = c.pose_a.position();
  const Eigen::Quaterniond small(1, turn.x() / 2, turn.y() / 2, turn.z() / 2);
  const bool turns = turn.x() != 0 || turn.y() != 0 || turn.z() != 0;
  const Eigen::Quaterniond& q = c.pose_a.orientation();
  return {c.a,
          Pose(Vec3(p.x() + by.x(), p.y() + by.y(), p.z() + by.z()), turns ? product(small, q) : q),
          c.b, c.pose_b};
}

Configuration perturbed(const Configuration& c, const Perturbation& p) {
  // One stream for each amplitude, so that every amplitude has its own direction.
  const auto exponent = static_cast<std::uint64_t>(-p.amplitude.exponent());
  Draw draw(rc::Random(rc::Random::Key{p.seed, p.number, stream, exponent}));
  const Vec3 direction = draw.direction(), axis = draw.direction();
  const double angle = p.number % 3 == 0 ? 0 : p.amplitude.value();
  const double length = p.number % 3 == 1 ? 0 : p.amplitude.value() * smaller_size(c);
  return moved(c, Vec3(angle * axis.x(), angle * axis.y(), angle * axis.z()),
               Vec3(length * direction.x(), length * direction.y(), length * direction.z()));
}

double largest_displacement(const Configuration& from, const Configuration& to) {
  const Eigen::Quaterniond &p = from.pose_a.orientation(), &q = to.pose_a.orientation();
  // The vector part of q p* is that of (q - p) p*, whose difference loses no digits.
  const Eigen::Quaterniond difference(q.w() - p.w(), q.x() - p.x(), q.y() - p.y(), q.z() - p.z());
  const double half_sine = product(difference, p.conjugate()).vec().norm() / (p.norm() * q.norm());
  const double circumradius = std::hypot(from.a.radius(), from.a.half_length());
  return (to.pose_a.position() - from.pose_a.position()).norm() + 2 * half_sine * circumradius;
}

}  // namespace touchstone
