#pragma once

#include <cstdint>
#include <string_view>

namespace touchstone {

/// FNV-1a, 64 bits: a number made from a name or from bytes, on all platforms alike.
inline std::uint64_t stable_hash(std::string_view bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3U;
  }
  return hash;
}

}  // namespace touchstone
