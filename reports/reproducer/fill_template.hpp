#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "reports/reproducer/texts.hpp"

namespace touchstone {

// Templates are programs with two additions: @name@ stands for a text, and a line that begins with
// [tag] or [tag,tag] is there only where one of the tags applies; with several brackets, one of
// each. A file may have sections, each after a line "=== name".

using Tags = std::vector<std::string_view>;

/// The names in a list with commas.
Tags names_in(std::string_view list);

/// The lines of a section, without the last line's end.
std::string_view section(std::string_view source, std::string_view name);

/// The template's lines for these tags with every @name@ replaced, without empty lines at the end;
/// what is put in is not searched again. Throws std::out_of_range for an unknown name.
std::string fill_template(std::string_view source, const Tags& tags, const Texts& texts);

}  // namespace touchstone
