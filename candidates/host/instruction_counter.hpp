#pragma once

#include <cstdint>
#include <optional>

namespace touchstone {

/// Counts the instructions that this process retires in user space, where machine and kernel allow
/// it (perf_event_open(2); kernel.perf_event_paranoid up to 2). Otherwise it counts nothing.
class InstructionCounter {
 public:
  InstructionCounter();
  ~InstructionCounter();
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  void start() const;
  /// Since start, within a few dozen; absent where they cannot be counted.
  std::optional<std::uint64_t> stop() const;

 private:
  int file_;  ///< -1: not allowed here
};

}  // namespace touchstone
