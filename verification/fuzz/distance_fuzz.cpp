// The target of libFuzzer (https://llvm.org/docs/LibFuzzer.html): our routines' answers to the
// configuration that bytes make must not contradict each other, nor, for one input in
// `truth_every`, the oracle. fuzz.sh builds and runs it.
#include <cstdint>
#include <cstdlib>
#include <iostream>

#include "properties/arbitrary.hpp"
#include "verification/fuzz/fuzz.hpp"

namespace {

/// A truth takes as long as about so many answers of ours.
constexpr std::uint64_t truth_every = 64;

/// Whether an input is compared with the truth depends on its bytes alone, so that it fails again.
std::uint64_t hash_of(std::span<const std::uint8_t> bytes) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001b3U;
  return hash ^ hash >> 32;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace touchstone;
  const std::span bytes(data, size);
  const Configuration c = configuration_from_bytes(bytes);
  std::optional<oracle::Truth> truth;
  if (hash_of(bytes) % truth_every == 0) truth = oracle::truth(c, 1e-20);
  if (const auto found = disagreement(c, own_answers(c), truth ? &*truth : nullptr)) {
    std::cerr << *found << '\n';
    showValue(c, std::cerr);
    std::cerr << std::endl;
    std::abort();
  }
  return 0;
}
