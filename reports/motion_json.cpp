#include "reports/motion_json.hpp"

#include <cstdint>
#include <cstring>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"

namespace touchstone {

nlohmann::json bodies_json(const Scene& scene) {
  nlohmann::json bodies = nlohmann::json::array();
  for (const Body& b : scene.bodies) {
    const auto& q = b.pose.orientation();
    bodies.push_back({{"name", b.name},
                      {"shape", to_json(b.shape)},
                      {"fixed", b.fixed},
                      {"pose",
                       {{"position", to_json(b.pose.position())},
                        {"orientation", {q.w(), q.x(), q.y(), q.z()}}}}});
  }
  return bodies;
}

std::string base64(const std::vector<float>& numbers) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::vector<std::uint8_t> bytes(numbers.size() * sizeof(float));
  if (!bytes.empty()) std::memcpy(bytes.data(), numbers.data(), bytes.size());
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      three = three << 8 | (i + k < bytes.size() ? bytes[i + k] : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

}  // namespace touchstone
