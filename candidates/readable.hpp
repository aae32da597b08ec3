#pragma once

#include <string>
#include <string_view>

namespace touchstone {

// Texts of others (names of files and bodies, what a plug-in says) where a person reads them.
// Characters that are not seen could move the cursor, turn the direction of what follows, or make
// one name look like another: controls, and what Unicode calls Default_Ignorable_Code_Point.

/// The text in one line of UTF-8: bytes of anything else become "?", characters that are not seen
/// become spaces. It stays as long as it is.
std::string readable(const std::string& text);

/// Where a text is printed, in lines or in one.
enum class Printed { lines, one_line };
/// The text with characters that are not seen as \u202e, and bytes that are no UTF-8 as \xe9. Ends
/// of lines and tabs stay where it is printed in lines, and so do our colours. JSON keeps its
/// meaning; with `backslash` doubled, its strings have the digits themselves.
std::string escaped(std::string_view text, Printed printed = Printed::lines,
                    std::string_view backslash = "\\");

}  // namespace touchstone
