#include "reports/certificate_json.hpp"

#include <algorithm>
#include <limits>

#include "properties/files/configuration_json.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

json exact(const audit::RationalVector& v) {
  return json::array({v[0].get_str(), v[1].get_str(), v[2].get_str()});
}

}  // namespace

json to_json(const audit::Certificate& certificate, const Configuration& configuration) {
  const double size = larger_size(configuration);
  const mpq_class width = (certificate.hi - certificate.lo) / mpq_class(size);
  json result = {{"schema", "touchstone-certificate-1"},
                 {"configuration", to_hex_json(configuration)},
                 {"exact", to_exact_json(configuration)},
                 {"signed_distance", {certificate.lo.get_str(), certificate.hi.get_str()}},
                 {"grain", certificate.grain.get_str()},
                 {"width", width.get_d()},
                 {"normal", exact(certificate.normal)}};
  if (certificate.pair) {
    result["pair"] = {{"a", exact(certificate.pair->a)}, {"b", exact(certificate.pair->b)}};
    return result;
  }
  result["cells"] = json::array();
  for (const auto& cell : certificate.cells) {
    result["cells"].push_back(
        {{"cell", cell.path}, {"a", exact(cell.pair.a)}, {"b", exact(cell.pair.b)}});
  }
  return result;
}

}  // namespace touchstone
