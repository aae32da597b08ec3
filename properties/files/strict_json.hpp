#pragma once

#include <array>
#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "reference/invalid_input.hpp"
#include "reference/shape.hpp"

namespace touchstone {

/// Deeper than anything that we read; what is not bounded would overflow the stack where a value is
/// copied or printed.
inline constexpr std::size_t max_json_depth = 64;

/// Parses JSON that a person or another program wrote: exactly one value (RFC 8259) of valid UTF-8,
/// a byte order mark before it or not, and nothing after it, no member given twice, no number
/// beyond the doubles, at most `max_json_depth` deep. Throws InvalidInput: where the text is no
/// JSON its field is `source` ("a file's name", "line") and its value says at which line and
/// column; otherwise its field is the path of the member ("bodies[3].shape.radius").
nlohmann::json parse_json(std::string_view text, const std::string& source);

/// The one value of the text, or those of JSON Lines, of which blank ones do not count; at least
/// one. Throws InvalidInput: of the text as a whole where not even its first line is JSON,
/// otherwise of the first line ("line 7") that is none.
std::vector<nlohmann::json> parse_json_lines(const std::string& text, const std::string& source);

/// Lines of JSON that come one by one, of any number; blank ones do not count. A copy keeps the
/// line that it is at.
class JsonLines {
 public:
  explicit JsonLines(std::istream& in) : in_(in) {}
  /// Goes on to the next line; false where there is none. Throws InvalidInput where an error ended
  /// the input (field "file"), of which the lines before it are good, and where a line does not end
  /// (/dev/zero; "line 7").
  bool next();
  std::uint64_t number() const { return number_; }  ///< of the line, from 1
  /// Throws InvalidInput (field "line") where the line is no JSON or longer than 1 MiB.
  nlohmann::json parse() const;

 private:
  bool read_line();
  std::istream& in_;
  std::string line_;
  std::uint64_t number_ = 0;
};

// Members of JSON that a person or another program wrote. Every reader throws InvalidInput with the
// full path of the field ("bodies[3].shape.radius"), what stood there and what would be right.

/// The value as the person wrote it, cut where it is long.
std::string shown(const nlohmann::json& value);
/// Throws InvalidInput with this field unless a terminal shows the name as it is: valid UTF-8
/// without characters that are not seen (candidates/readable.hpp).
void check_printable(const std::string& field, const std::string& name);

/// A JSON number, or a string with a decimal or hexadecimal float.
double number(const nlohmann::json& value, const std::string& field);

/// The same, or nothing where null stands.
std::optional<double> number_or_null(const nlohmann::json& value, const std::string& field);
/// Writes null for what is absent or not finite: JSON has no other word for it.
nlohmann::json or_null(const std::optional<double>& value);

/// A whole number from 0 to `max`.
std::uint64_t whole_number(const nlohmann::json& value, const std::string& field,
                           std::uint64_t max = UINT64_MAX);

std::string string(const nlohmann::json& value, const std::string& field);

/// The text of the id that an object gives itself by its member "id", by which it is asked for and
/// told from others: a string as it is; a number, true, false or null as JSON writes it, so that 0
/// and "0" are one id.
std::string id_of(const nlohmann::json& object);

/// The value itself, which is an array.
const nlohmann::json& array(const nlohmann::json& value, const std::string& field);

/// The member of that name; `path` is that of the object, empty for the whole text.
const nlohmann::json& member(const nlohmann::json& object, const char* name,
                             const std::string& path);

void require_object(const nlohmann::json& value, const std::string& field);

/// Refuses members that are not known.
void refuse_others(const nlohmann::json& object, const std::vector<std::string>& known,
                   const std::string& path);

/// An array of exactly so many numbers.
void read_numbers(const nlohmann::json& value, const std::string& field, std::span<double> numbers);
template <std::size_t N>
std::array<double, N> numbers(const nlohmann::json& value, const std::string& field) {
  std::array<double, N> result;
  read_numbers(value, field, result);
  return result;
}

Vec3 vector(const nlohmann::json& value, const std::string& field);

/// The constructors name the field within the shape; the path in front of it is added here.
template <class Make>
auto at_path(const std::string& path, Make make) {
  try {
    return make();
  } catch (const InvalidInput& e) {
    throw e.within(path);
  }
}

}  // namespace touchstone
