#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace touchstone {

/// NumPy's file of named arrays, which numpy.load reads: an archive in the ZIP format, not
/// compressed, of .npy files (numpy.lib.format, version 1.0; PKWARE's APPNOTE, 4.3).
class NpzFile {
 public:
  // The array of that name, made at the first use, to which values are appended.

  std::vector<std::string>& texts(const std::string& name);      ///< ASCII, one dimension
  std::vector<std::int64_t>& integers(const std::string& name);  ///< one dimension
  /// One dimension if `width` is 1, otherwise rows of so many values.
  std::vector<double>& doubles(const std::string& name, std::size_t width = 1);

  /// The whole file. Throws InvalidInput (field "--count") beyond the 4 GiB of the ZIP format.
  std::string bytes() const;

 private:
  struct Array {
    std::variant<std::vector<std::string>, std::vector<std::int64_t>, std::vector<double>> values;
    std::size_t width = 1;
  };
  static std::string npy(const Array& array);

  std::map<std::string, Array> arrays_;
};

}  // namespace touchstone
