#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace touchstone {

/// How a candidate is marked on every page and figure: a colour for each engine, a symbol for each
/// of its settings. What is not known here shares the last colour and has a symbol by its name.
struct Mark {
  std::size_t colour;  ///< 0 … 7: --c0 … --c7 of the pages' style sheet
  std::size_t symbol;  ///< 0 … 5: of `symbols` in elements.js
};
Mark mark_of(std::string_view candidate);

/// {name: [colour, symbol]} for a page's script.
nlohmann::json marks(const std::vector<std::string>& candidates);

}  // namespace touchstone
