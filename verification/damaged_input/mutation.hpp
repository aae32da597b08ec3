#pragma once

#include <cstdint>
#include <random>
#include <string>

namespace touchstone {

/// Damages true input for tests, the same way for the same seed on every machine: bytes are
/// changed, numbers made extreme, tokens replaced, lines cut, joined and repeated, and members of
/// JSON dropped, repeated, renamed and given another type.
class Mutation {
 public:
  explicit Mutation(std::uint64_t seed) : random_(seed) {}

  /// One to four changes. Texts that are JSON are changed as such half of the time, numbers first,
  /// so that they go past the parser.
  std::string of(const std::string& text);

 private:
  std::size_t below(std::size_t n) { return n == 0 ? 0 : random_() % n; }
  bool one_in(std::size_t n) { return below(n) == 0; }
  std::string change_bytes(std::string text);
  std::string change_number(std::string text);
  std::string change_lines(const std::string& text);
  std::string change_json(const std::string& text);
  std::string repeat_member(std::string text);
  const std::string& nasty();
  const std::string& extreme_number();

  std::mt19937_64 random_;
};

}  // namespace touchstone
