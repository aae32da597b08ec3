#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace touchstone {

/// Deeper than anything that we read; what is not bounded would overflow the stack where a value is
/// copied or printed.
inline constexpr std::size_t max_json_depth = 64;

/// Parses JSON that a person or another program wrote: exactly one value (RFC 8259) of valid UTF-8
/// and nothing after it, no member given twice, no number beyond the doubles, at most
/// `max_json_depth` deep. Throws InvalidInput: where the text is no JSON its field is `source` ("a
/// file's name", "line") and its value says at which line and column; otherwise its field is the
/// path of the member ("bodies[3].shape.radius").
nlohmann::json parse_json(std::string_view text, const std::string& source);

/// The one value of the text, or those of JSON Lines, of which blank ones do not count; at least
/// one. Throws InvalidInput: of the text as a whole where not even its first line is JSON,
/// otherwise of the first line ("line 7") that is none.
std::vector<nlohmann::json> parse_json_lines(const std::string& text, const std::string& source);

}  // namespace touchstone
