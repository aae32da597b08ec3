#include "reports/compare_page/compare_page.hpp"

#include <string>
#include <vector>

#include "reference/invalid_input.hpp"
#include "reports/html/marks.hpp"
#include "reports/pages/page.hpp"

namespace touchstone {

std::string compare_page(const nlohmann::json& comparison, const nlohmann::json& before,
                         const nlohmann::json& after) {
  std::vector<std::string> names;
  for (const auto* summary : {&before["summary"], &after["summary"]}) {
    for (const auto& row : *summary) names.push_back(row["candidate"]);
  }
  return render_page(Page::comparison, {{"comparison", comparison},
                                        {"before", before["summary"]},
                                        {"after", after["summary"]},
                                        {"marks", marks(names)}});
}

}  // namespace touchstone
