#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace touchstone {

/// NumPy's file of named arrays, which numpy.load reads: an archive in the ZIP format, not
/// compressed, of .npy files (numpy.lib.format, version 1.0; PKWARE's APPNOTE, 4.3). Its arrays
/// grow by one entry with each datum; those of lists by one for each normal, where `first_normal`
/// says which belong to which datum.
class NpzFile {
 public:
  void text(const std::string& name, const std::string& value) { texts(name, {value}); }
  void numbers(const std::string& name, const std::string& letters,
               const std::vector<double>& values) {
    vectors(name, std::max<std::size_t>(1, letters.size()), values);
  }
  void lists_of(std::size_t count) {
    auto& first = array<std::int64_t>("first_normal");
    if (first.empty()) first.push_back(0);
    first.push_back(first.back() + static_cast<std::int64_t>(count));
  }
  /// ASCII.
  void texts(const std::string& name, const std::vector<std::string>& values) {
    auto& all = array<std::string>(name);
    all.insert(all.end(), values.begin(), values.end());
  }
  void vectors(const std::string& name, std::size_t width, const std::vector<double>& values) {
    auto& all = array<double>(name, width);
    all.insert(all.end(), values.begin(), values.end());
  }

  /// The whole file. Throws InvalidInput (field "--count") beyond the 4 GiB of the ZIP format.
  std::string bytes() const;

 private:
  /// One dimension if `width` is 1, otherwise rows of so many values.
  struct Array {
    std::variant<std::vector<std::string>, std::vector<std::int64_t>, std::vector<double>> values;
    std::size_t width;
  };
  /// The array of that name, made at the first use.
  template <class Value>
  std::vector<Value>& array(const std::string& name, std::size_t width = 1) {
    auto [entry, is_new] = arrays_.try_emplace(name, Array{std::vector<Value>(), width});
    return std::get<std::vector<Value>>(entry->second.values);
  }
  static std::string npy(const Array& array);

  std::map<std::string, Array> arrays_;
};

}  // namespace touchstone
