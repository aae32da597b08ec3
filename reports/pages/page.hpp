#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "reference/shape.hpp"

namespace touchstone {

struct Scene;

enum class Page { report, comparison, replay, stability, choice, engines, history };

/// One self-contained HTML file: the shell that all pages share (page.html), filled with a page's
/// own part, its scripts and, compressed, Vega and its data. It loads nothing from elsewhere, and
/// no string of the data can break out of it.
std::string render_page(Page page, const nlohmann::json& data);

/// The mark of a candidate on every page and figure: a colour for each engine, a symbol for each of
/// its settings and releases. A candidate that is not known here is grey and has a symbol by its
/// name.
struct Mark {
  std::size_t colour;  ///< 0 … 15: --c0 … --c15 of the pages' style sheet
  std::size_t symbol;  ///< 0 … 5: of `symbols` in page.js
};
Mark mark_of(std::string_view candidate);

// Motions as pages read them (pages/motion.js):

/// The faces of a convex body, each a list of indices of its vertices; of another shape none.
nlohmann::json faces_json(const Shape& shape);
/// Names, shapes and initial poses of a scene's bodies.
nlohmann::json bodies_json(const Scene& scene);

/// Bytes in base64 (RFC 4648).
std::string base64(std::span<const unsigned char> bytes);
std::string base64(const std::vector<float>& numbers);

}  // namespace touchstone
