#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "candidates/host/candidate_process.hpp"
#include "oracle/truth.hpp"
#include "properties/files/named_members.hpp"
#include "reference/configuration.hpp"

namespace touchstone {

// Values as bytes, on their way between two processes of the same program: as they lie in memory,
// without a version. An aggregate is taken apart into its members. A type that is none, or of which
// bytes say less or more, lists what they say once, for both ways, in its own namespace:
//
//   template <class Archive>
//   friend void members(Archive& a, Magnitudes& m) { a(m.resolution_, m.entries_, m.max_); }
//
// A type that is trivially copyable and lists none is written whole; it must not point to anything.

template <class T, class Archive>
concept ListsMembers = requires(Archive& a, T& x) {
  members(a, x);
};

/// Is it written as it lies in memory?
template <class T, class Archive>
concept IsRaw = std::is_trivially_copyable_v<T> && !ListsMembers<T, Archive>;

template <class T>
T blank();
/// A member of any type, where an aggregate is made. (An optional of a type of Eigen would be made
/// of it directly, which cannot be compiled: a type with such a member lists its members.)
struct BlankMember {
  template <class T>
  operator T() const {
    return blank<T>();
  }
};

template <class T, std::size_t... i>
constexpr bool is_made_of(std::index_sequence<i...>) {
  return requires { T{(void(i), BlankMember())...}; };
}
/// Number of an aggregate's members, `max` at most.
template <class T, std::size_t max = 11>
constexpr std::size_t member_count() {
  static_assert(max > 0, "neither an aggregate nor a type that lists its members");
  if constexpr (is_made_of<T>(std::make_index_sequence<max>())) {
    return max;
  } else {
    return member_count<T, max - 1>();
  }
}

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"  // an optional is made of a blank value
/// A value to read another one into.
template <class T>
T blank() {
  if constexpr (std::default_initializable<T>) {
    return T();
  } else {
    return []<std::size_t... i>(std::index_sequence<i...>) {
      return T{(void(i), BlankMember())...};
    }
    (std::make_index_sequence<member_count<T>()>());
  }
}
#pragma GCC diagnostic pop

/// Hands an aggregate's members to an archive, in their order.
template <class Archive, class T>
void take_apart(Archive& archive, T& x) {
  constexpr std::size_t n = member_count<T>();
  static_assert(n < 11, "an aggregate of more than ten members");
  // clang-format off
  if constexpr (n == 1) { auto& [a] = x; archive(a); }
  if constexpr (n == 2) { auto& [a, b] = x; archive(a, b); }
  if constexpr (n == 3) { auto& [a, b, c] = x; archive(a, b, c); }
  if constexpr (n == 4) { auto& [a, b, c, d] = x; archive(a, b, c, d); }
  if constexpr (n == 5) { auto& [a, b, c, d, e] = x; archive(a, b, c, d, e); }
  if constexpr (n == 6) { auto& [a, b, c, d, e, f] = x; archive(a, b, c, d, e, f); }
  if constexpr (n == 7) { auto& [a, b, c, d, e, f, g] = x; archive(a, b, c, d, e, f, g); }
  if constexpr (n == 8) { auto& [a, b, c, d, e, f, g, h] = x; archive(a, b, c, d, e, f, g, h); }
  if constexpr (n == 9) { auto& [a, b, c, d, e, f, g, h, i] = x; archive(a, b, c, d, e, f, g, h, i); }
  if constexpr (n == 10) { auto& [a, b, c, d, e, f, g, h, i, j] = x; archive(a, b, c, d, e, f, g, h, i, j); }
  // clang-format on
}

class BytesOut {
 public:
  static constexpr bool reads = false, is_bytes = true;

  template <class... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  /// Of a type that lists its members by name (named_members.hpp).
  template <class T, class... Rules>
  void named(const char*, const T& value, const Rules&...) {
    put(value);
  }
  /// Of what comes next.
  template <class Container>
  void size(const Container& x) {
    put(x.size());
  }
  void raw(const void* bytes, std::size_t size) {
    bytes_.append(static_cast<const char*>(bytes), size);
  }
  std::string take() { return std::move(bytes_); }

 private:
  template <class T>
  void put(const T& x) {
    if constexpr (IsRaw<T, BytesOut>) {
      static_assert(!std::is_pointer_v<T> && !std::is_same_v<T, std::string_view>);
      raw(&x, sizeof x);
    } else {
      // What is said to be no constant is only read, as `reads` says.
      if constexpr (ListsMembers<T, BytesOut>) {
        members(*this, const_cast<T&>(x));
      } else {
        take_apart(*this, x);
      }
    }
  }

  std::string bytes_;
};

template <>
inline Plane blank<Plane>() {
  return {Vec3(0, 0, 1), 0};
}
template <>
inline Box blank<Box>() {
  return Box(Vec3(1, 1, 1));
}
template <>
inline Sphere blank<Sphere>() {
  return Sphere(1);
}
template <>
inline Capsule blank<Capsule>() {
  return {1, 1};
}
template <>
inline Cylinder blank<Cylinder>() {
  return {1, 1};
}
template <>
inline Convex blank<Convex>() {
  return {{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)}, {{0, 1, 2}, {2, 1, 0}}};
}
template <>
inline Shape blank<Shape>() {
  return blank<Sphere>();
}

/// Reads what a BytesOut was given, in the same order.
class BytesIn {
 public:
  static constexpr bool reads = true, is_bytes = true;

  explicit BytesIn(std::string_view bytes) : rest_(bytes) {}

  template <class... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  template <class T, class... Rules>
  void named(const char*, T& value, const Rules&...) {
    get(value);
  }
  template <class T>
  T next() {
    T x = blank<T>();
    get(x);
    return x;
  }
  template <class Container>
  void size(Container& x) {
    const auto size = next<std::size_t>();
    if (size > rest_.size()) end_too_early();
    if constexpr (std::default_initializable<typename Container::value_type>) {
      x.resize(size);
    } else {
      x.resize(size, blank<typename Container::value_type>());
    }
  }
  void raw(void* to, std::size_t size) {
    if (size > rest_.size()) end_too_early();
    if (size > 0) std::memcpy(to, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  /// Has all been read?
  bool is_at_end() const { return rest_.empty(); }

 private:
  [[noreturn]] static void end_too_early() { throw std::logic_error("bytes end too early"); }

  template <class T>
  void get(T& x) {
    if constexpr (IsRaw<T, BytesIn>) {
      raw(&x, sizeof x);
    } else if constexpr (ListsMembers<T, BytesIn>) {
      members(*this, x);
    } else {
      take_apart(*this, x);
    }
  }

  std::string_view rest_;
};

template <class... T>
std::string to_bytes(const T&... values) {
  BytesOut out;
  out(values...);
  return out.take();
}
template <class T>
T from_bytes(std::string_view bytes) {
  return BytesIn(bytes).next<T>();
}

// The library's types.

template <class Archive>
void members(Archive& a, std::string& x) {
  a.size(x);
  a.raw(x.data(), x.size());
}
template <class Archive, class T>
void members(Archive& a, std::vector<T>& x) {
  a.size(x);
  if constexpr (IsRaw<T, Archive>) {
    a.raw(x.data(), x.size() * sizeof(T));
  } else {
    for (T& each : x) a(each);
  }
}
template <class Archive, class T, std::size_t n>
void members(Archive& a, std::array<T, n>& x) {
  for (T& each : x) a(each);
}
template <class Archive, class A, class B>
void members(Archive& a, std::pair<A, B>& x) {
  a(x.first, x.second);
}
template <class Archive, class T>
void members(Archive& a, std::optional<T>& x) {
  bool has_value = x.has_value();
  a(has_value);
  if constexpr (Archive::reads) x = has_value ? std::optional<T>(blank<T>()) : std::nullopt;
  if (x) a(*x);
}
template <class Archive, class... T>
void members(Archive& a, std::variant<T...>& x) {
  std::size_t index = x.index(), at = 0;
  a(index);
  if constexpr (Archive::reads) ((at++ == index ? void(x = blank<T>()) : void()), ...);
  std::visit([&](auto& each) { a(each); }, x);
}
/// A map, of the standard library or of Boost.
template <class Archive, class Map>
requires requires { typename Map::mapped_type; }
void members(Archive& a, Map& x) {
  if constexpr (Archive::reads) {
    for (auto left = a.template next<std::size_t>(); left > 0; --left) {
      auto key = a.template next<typename Map::key_type>();
      x.emplace_hint(x.end(), std::move(key), a.template next<typename Map::mapped_type>());
    }
  } else {
    a.size(x);
    for (auto& [key, value] : x) a(key, value);
  }
}

// The vocabulary's.

template <class Archive>
void members(Archive& a, Vec3& x) {
  a(x.x(), x.y(), x.z());
}
template <class Archive>
void members(Archive& a, Eigen::Quaterniond& x) {
  a(x.w(), x.x(), x.y(), x.z());
}
template <class Archive>
void members(Archive& a, Pose& x) {
  if constexpr (Archive::reads) {
    const auto position = a.template next<Vec3>();
    x = Pose(position, a.template next<Eigen::Quaterniond>());
  } else {
    a(x.position(), x.orientation());
  }
}
template <class Archive>
void members(Archive& a, Plane& x) {
  if constexpr (Archive::reads) {
    const auto normal = a.template next<Vec3>();
    x = Plane(normal, a.template next<double>());
  } else {
    a(x.normal(), x.displacement());
  }
}
template <class Archive>
void members(Archive& a, Box& x) {
  if constexpr (Archive::reads) {
    const auto half_extents = a.template next<Vec3>();
    x = Box(half_extents, a.template next<double>());
  } else {
    a(x.half_extents(), x.rounding());
  }
}
template <class Archive>
void members(Archive& a, Convex& x) {
  std::vector<std::vector<int>> faces;
  if constexpr (Archive::reads) {
    auto vertices = a.template next<std::vector<Vec3>>();
    a(faces);
    x = Convex(std::move(vertices), std::move(faces), a.template next<double>());
  } else {
    for (const Convex::Face& face : x.faces()) faces.push_back(face.vertices);
    a(x.vertices(), faces, x.rounding());
  }
}
template <class Archive>
void members(Archive& a, Answer& x) {
  a(static_cast<ts_answer&>(x), x.reason, x.model_distance, x.roundings, x.was_asked);
}

namespace oracle {

/// Exact numbers, in the most compact base of GMP.
template <class Archive>
void members(Archive& a, Enclosure& x) {
  constexpr int base = 62;
  for (mpq_class* end : {&x.lo, &x.hi}) {
    std::string text = end->get_str(base);
    a(text);
    if constexpr (Archive::reads) *end = mpq_class(text, base);
  }
}

}  // namespace oracle
}  // namespace touchstone
