#include "reports/test_data/npz_file.hpp"

#include <algorithm>
#include <bit>
#include <boost/crc.hpp>
#include <fmt/format.h>
#include <limits>
#include <string_view>

#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

static_assert(std::endian::native == std::endian::little);  // as all numbers of both formats

template <class... Numbers>
std::string little_endian(Numbers... numbers) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(&numbers), sizeof numbers), ...);
  return bytes;
}

/// The type and the bytes of an array's values.
struct Data {
  std::string type, bytes;
  std::size_t count;
};

template <class Number>
Data data_of(const std::vector<Number>& values, const char* type) {
  const auto* first = reinterpret_cast<const char*>(values.data());
  return {type, std::string(first, values.size() * sizeof(Number)), values.size()};
}

struct ToData {
  Data operator()(const std::vector<double>& values) const { return data_of(values, "<f8"); }
  Data operator()(const std::vector<std::int64_t>& values) const { return data_of(values, "<i8"); }
  /// Four bytes a character, all texts as long as the longest.
  Data operator()(const std::vector<std::string>& values) const {
    std::size_t length = 1;
    for (const std::string& text : values) length = std::max(length, text.size());
    std::string bytes;
    for (const std::string& text : values) {
      for (std::size_t i = 0; i < length; ++i) {
        const char c = i < text.size() ? text[i] : '\0';
        bytes += {c, '\0', '\0', '\0'};
      }
    }
    return {fmt::format("<U{}", length), std::move(bytes), values.size()};
  }
};

/// What the local header and the directory say alike of a file that is stored as it is: version,
/// flags, method, time and date (1 January 1980), checksum, sizes, lengths of the name and of what
/// follows it.
std::string description(const std::string& name, std::string_view content) {
  boost::crc_32_type checksum;
  checksum.process_bytes(content.data(), content.size());
  const auto size = static_cast<std::uint32_t>(content.size());
  constexpr std::uint16_t version = 20, flags = 0, stored = 0, time = 0, date = 0x21, extra = 0;
  return little_endian(version, flags, stored, time, date,
                       static_cast<std::uint32_t>(checksum.checksum()), size, size,
                       static_cast<std::uint16_t>(name.size()), extra);
}

}  // namespace

std::string NpzFile::npy(const Array& array) {
  const auto [type, bytes, count] = std::visit(ToData(), array.values);
  const std::string shape = array.width == 1
                                ? fmt::format("{},", count)
                                : fmt::format("{}, {}", count / array.width, array.width);
  std::string header =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, shape);
  // Blanks and a line feed, so that the values begin at a multiple of 64 bytes.
  constexpr std::size_t before = 10, alignment = 64;
  header.append(alignment - 1 - (before + header.size()) % alignment, ' ');
  header += '\n';
  return "\x93NUMPY\x01" + std::string(1, '\0') +
         little_endian(static_cast<std::uint16_t>(header.size())) + header + bytes;
}

std::string NpzFile::bytes() const {
  constexpr std::size_t max_size = std::numeric_limits<std::uint32_t>::max();
  std::string files, directory;
  for (const auto& [array_name, array] : arrays_) {
    const std::string name = array_name + ".npy", content = npy(array);
    if (files.size() + content.size() + 4096 + directory.size() > max_size) {
      throw InvalidInput("--count", "more than 4 GiB of arrays",
                         "must be smaller for this format; csv and jsonl have no bound");
    }
    const std::string described = description(name, content);
    constexpr std::uint16_t made_by = 20, no_comment = 0, disk = 0, attributes = 0;
    constexpr std::uint32_t external_attributes = 0;
    directory += "PK\x01\x02" + little_endian(made_by) + described +
                 little_endian(no_comment, disk, attributes, external_attributes,
                               static_cast<std::uint32_t>(files.size())) +
                 name;
    files += "PK\x03\x04" + described + name + content;
  }
  const auto count = static_cast<std::uint16_t>(arrays_.size());
  constexpr std::uint16_t disk = 0, no_comment = 0;
  return files + directory + "PK\x05\x06" +
         little_endian(disk, disk, count, count, static_cast<std::uint32_t>(directory.size()),
                       static_cast<std::uint32_t>(files.size()), no_comment);
}

}  // namespace touchstone
