#include "reports/replay_page/replay_page.hpp"

#include "reference/invalid_input.hpp"
#include "reports/html/marks.hpp"
#include "reports/pages/page.hpp"

namespace touchstone {

std::string replay_page(nlohmann::json examined, const nlohmann::json& hexadecimal,
                        const nlohmann::json& exact, std::string_view description) {
  examined["hexadecimal"] = hexadecimal;
  examined["exact"] = exact;
  examined["description"] = description;
  std::vector<std::string> names;
  for (const auto& [name, unused] : examined["answers"].items()) names.push_back(name);
  examined["marks"] = marks(names);
  return render_page(Page::replay, examined);
}

}  // namespace touchstone
