#include "reports/stability/stability_page.hpp"

#include "reports/html/marks.hpp"
#include "reports/pages/page.hpp"

namespace touchstone {

std::string stability_page(const nlohmann::json& stability) {
  nlohmann::json data = stability;
  data["marks"] = marks(stability["candidates"]);
  return render_page(Page::stability, data);
}

}  // namespace touchstone
