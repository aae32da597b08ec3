#pragma once

#include <cstdint>
#include <span>

#include "reference/configuration.hpp"

namespace touchstone {

/// A configuration of any bytes, missing ones being zero: always a valid one. Most of its numbers
/// stand as a choice of a byte or as a number of seven more: sizes equal an earlier one, axes are
/// parallel or perpendicular, offsets are sums of sizes, each but for a difference of any magnitude
/// down to 2^-60. So bytes that are changed one by one walk from case to case, and to what lies
/// between. Sizes lie between 2^-7 and 2^7 metres, both bodies in any frame.
Configuration configuration_from_bytes(std::span<const std::uint8_t> bytes);

}  // namespace touchstone
