// fuzz_case FILE prints the configuration that an input of the fuzzer makes, as a line for replay.
#include <fstream>
#include <iostream>
#include <iterator>
#include <vector>

#include <nlohmann/json.hpp>

#include "properties/files/configuration_json.hpp"
#include "verification/fuzz/fuzz.hpp"

int main(int count, char** arguments) {
  std::ifstream file(count == 2 ? arguments[1] : "", std::ios::binary);
  if (!file) {
    std::cerr << "fuzz_case FILE: must be a file that can be read, such as a crash-… of fuzz.sh\n";
    return 2;
  }
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
  const auto* data = reinterpret_cast<const std::uint8_t*>(bytes.data());
  std::cout << touchstone::to_hex_json(touchstone::configuration_from_bytes({data, bytes.size()}))
            << '\n';
}
