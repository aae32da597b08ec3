#pragma once

#include <gtest/gtest.h>
#include <string>
#include <zlib.h>

#include <nlohmann/json.hpp>

namespace touchstone {

/// A page's data as its script reads it.
inline nlohmann::json data_of(const std::string& page) {
  const std::string open = R"(id="data">)";
  const std::size_t start = page.find(open) + open.size();
  std::string packed;
  unsigned bits = 0, count = 0;
  for (const char c : page.substr(start, page.find('<', start) - start)) {
    const auto digit =
        std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
    if (digit == std::string::npos) break;  // "=" fills up
    bits = bits << 6 | static_cast<unsigned>(digit), count += 6;
    if (count >= 8) packed += static_cast<char>(bits >> (count -= 8) & 255U);
  }
  std::string text(std::size_t{1} << 22, ' ');
  uLongf size = text.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  return nlohmann::json::parse(text.substr(0, size));
}

}  // namespace touchstone
