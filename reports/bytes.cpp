#include "reports/bytes.hpp"

#include <stdexcept>

#include "properties/numbers.hpp"

namespace touchstone {
namespace {

constexpr int base = 62;  // the most compact one of GMP

}  // namespace

void ByteWriter::put(const Configuration& c) {
  Numbers numbers = numbers_of(c);
  put(numbers.pair);
  for (const double* number : every_number(numbers)) put(*number);
}

Configuration ByteReader::get_configuration() {
  Numbers numbers;
  numbers.pair = get<Pair>();
  numbers.sizes.resize(size_count(numbers.pair));
  for (double* number : every_number(numbers)) *number = get<double>();
  return configuration_of(numbers);
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
