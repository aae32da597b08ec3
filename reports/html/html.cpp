#include "reports/html/html.hpp"

#include "reports/html/page_data.hpp"
#include "reports/pages/page.hpp"

namespace touchstone {

std::string render_html(const nlohmann::json& report) {
  return render_page(Page::report, page_data(report));
}

}  // namespace touchstone
