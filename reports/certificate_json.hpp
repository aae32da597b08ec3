#pragma once

#include <nlohmann/json.hpp>

#include "oracle/audit/certificate.hpp"

namespace touchstone {

/// The certificate with the configuration that it is about, as docs/certificate.md describes.
nlohmann::json to_json(const audit::Certificate& certificate, const Configuration& configuration);

}  // namespace touchstone
