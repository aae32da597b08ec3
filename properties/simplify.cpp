#include "properties/simplify.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "properties/numbers.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

int complexity(double x) {
  if (x == 0) return 0;
  if (std::abs(x) == 1) return 1;
  constexpr int mantissa_bits = 53;
  int exponent = 0;
  const auto mantissa =
      static_cast<std::uint64_t>(std::ldexp(std::frexp(std::abs(x), &exponent), mantissa_bits));
  const int bits = mantissa_bits - std::countr_zero(mantissa);
  return 2 + bits + std::abs(exponent) / 4 + (x < 0 ? 1 : 0);
}

template <class Coordinates>
int total(const Coordinates& v) {
  int sum = 0;
  for (int i = 0; i < v.size(); ++i) sum += complexity(v[i]);
  return sum;
}

int complexity(const Eigen::Quaterniond& q) {
  const bool is_identity = q.vec().isZero(0);
  return is_identity ? complexity(q.w()) : 4 + total(q.coeffs());
}

/// Rounds to that many significant bits.
double rounded(double x, int bits) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  return std::ldexp(std::round(std::ldexp(mantissa, bits)), exponent - bits);
}

constexpr int bit_steps[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 36};

/// Simpler values of one number, the simplest first.
std::vector<double> simpler_numbers(double x, bool positive) {
  std::vector<double> result;
  if (!positive) result.push_back(0);
  result.push_back(1);
  if (!positive) result.push_back(-1);
  if (std::abs(x) < 0x1p53) result.push_back(std::round(x));
  for (const int bits : bit_steps) result.push_back(rounded(x, bits));
  std::erase_if(result, [&](double y) {
    return !(std::isfinite(y) && complexity(y) < complexity(x)) || (positive && !(y > 0));
  });
  return result;
}

std::vector<Eigen::Quaterniond> simpler_orientations(const Eigen::Quaterniond& q) {
  std::vector<Eigen::Quaterniond> result{Eigen::Quaterniond(1, 0, 0, 0)};
  // The largest coordinate becomes 1, 2, 4, …, the others integers.
  const double largest = q.coeffs().cwiseAbs().maxCoeff();
  for (const double scale : {1.0, 2.0, 4.0, 8.0, 16.0, 64.0, 256.0, 0x1p16, 0x1p24, 0x1p32}) {
    Eigen::Quaterniond r;
    r.coeffs() = (q.coeffs() * (scale / largest)).array().round().matrix();
    result.push_back(r);
  }
  for (int i = 0; i < 4; ++i) {
    for (const double y : simpler_numbers(q.coeffs()[i], false)) {
      Eigen::Quaterniond r = q;
      r.coeffs()[i] = y;
      result.push_back(r);
    }
  }
  std::erase_if(result, [&](const auto& r) {
    return r.coeffs().isZero(0) || complexity(r) >= complexity(q);
  });
  return result;
}

class Simplifier {
 public:
  explicit Simplifier(const Configuration& c) : start_(numbers_of(c)), complexity_(complexity(c)) {}

  /// A step that changes the numbers in place.
  template <class Change>
  void add(const Change& change) {
    Numbers next = start_;
    change(next);
    try {
      Configuration c = configuration_of(next);
      if (complexity(c) < complexity_) result_.push_back(std::move(c));
    } catch (const InvalidInput&) {
      // Rounding may leave the range of valid numbers: skip the step.
    }
  }

  const Numbers& start() const { return start_; }
  std::vector<Configuration> take() { return std::move(result_); }

 private:
  Numbers start_;
  int complexity_;
  std::vector<Configuration> result_;
};

Eigen::Quaterniond unit_length(const Eigen::Quaterniond& q) {
  return Pose(Vec3::Zero(), q).unit_orientation();
}

/// Both bodies in B's frame.
void see_from_b(Numbers& n) {
  const Eigen::Quaterniond back = unit_length(n.orientation_b).conjugate();
  n.position_a = back * (n.position_a - n.position_b);
  n.orientation_a = back * unit_length(n.orientation_a);
  n.position_b.setZero();
  n.orientation_b.setIdentity();
}

void move_to_the_origin(Simplifier& steps) {
  steps.add(see_from_b);
  steps.add([](Numbers& n) {
    n.position_a -= n.position_b;
    n.position_b.setZero();
  });
  steps.add([](Numbers& n) { n.position_a.setZero(); });
  steps.add([](Numbers& n) { n.position_b.setZero(); });
}

}  // namespace

int complexity(const Configuration& c) {
  const Numbers n = numbers_of(c);
  int sum = 0;
  for (const double size : n.sizes) sum += complexity(size);
  sum += complexity(n.rounding_a) + complexity(n.rounding_b);
  for (const Vec3& vertex : n.vertices) sum += 1 + total(vertex);
  return sum + total(n.position_a) + total(n.position_b) + complexity(n.orientation_a) +
         complexity(n.orientation_b) + total(n.normal) + complexity(n.displacement);
}

int complexity(const CastQuestion& cast) {
  return complexity(cast.configuration) + total(cast.sweep);
}

std::vector<Configuration> simpler(const Configuration& configuration) {
  Simplifier steps(configuration);
  const Numbers& start = steps.start();
  move_to_the_origin(steps);
  steps.add([](Numbers& n) { n.sizes.assign(n.sizes.size(), 1); });
  for (const auto orientation : {&Numbers::orientation_a, &Numbers::orientation_b}) {
    for (const auto& q : simpler_orientations(start.*orientation)) {
      steps.add([&](Numbers& n) { n.*orientation = q; });
    }
  }
  for (std::size_t i = 0; i < start.sizes.size(); ++i) {
    for (const double x : simpler_numbers(start.sizes[i], true)) {
      steps.add([&](Numbers& n) { n.sizes[i] = x; });
    }
  }
  for (std::size_t i = 0; i < start.vertices.size(); ++i) {
    steps.add([i](Numbers& n) { n.vertices.erase(n.vertices.begin() + static_cast<long>(i)); });
    for (int k = 0; k < 3; ++k) {
      for (const double x : simpler_numbers(start.vertices[i][k], false)) {
        steps.add([&](Numbers& n) { n.vertices[i][k] = x; });
      }
    }
  }
  for (const auto vector : {&Numbers::position_a, &Numbers::position_b, &Numbers::normal}) {
    for (int i = 0; i < 3; ++i) {
      for (const double x : simpler_numbers((start.*vector)[i], false)) {
        steps.add([&](Numbers& n) { (n.*vector)[i] = x; });
      }
    }
  }
  for (const auto number : {&Numbers::displacement, &Numbers::rounding_a, &Numbers::rounding_b}) {
    for (const double x : simpler_numbers(start.*number, false)) {
      steps.add([&](Numbers& n) { n.*number = x; });
    }
  }
  return steps.take();
}

std::vector<CastQuestion> simpler(const CastQuestion& cast) {
  std::vector<CastQuestion> result;
  Numbers seen = numbers_of(cast.configuration);
  const Eigen::Quaterniond back = unit_length(seen.orientation_b).conjugate();
  see_from_b(seen);
  try {
    result.push_back({configuration_of(seen), back * cast.sweep});
  } catch (const InvalidInput&) {
    // As a Simplifier skips it.
  }
  for (Configuration& c : simpler(cast.configuration)) result.push_back({std::move(c), cast.sweep});
  for (int i = 0; i < 3; ++i) {
    for (const double x : simpler_numbers(cast.sweep[i], false)) {
      result.push_back(cast);
      result.back().sweep[i] = x;
    }
  }
  std::erase_if(result, [&](const CastQuestion& q) {
    return !q.sweep.allFinite() || complexity(q) >= complexity(cast);
  });
  return result;
}

Configuration simplified(const Configuration& configuration,
                         const std::function<bool(const Configuration&)>& still_fails,
                         int max_trials) {
  return simplified_in_batches(
      configuration,
      [&](const std::vector<Configuration>& next) {
        return static_cast<std::size_t>(std::ranges::find_if(next, still_fails) - next.begin());
      },
      static_cast<std::size_t>(max_trials));
}

}  // namespace touchstone
