#include "reports/progress.hpp"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>
#include <utility>

namespace touchstone {

Progress::Progress(std::string unit, std::size_t total)
    : unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      printed_(start_) {}

Progress::~Progress() {
  if (terminal_) fmt::print(stderr, "\r\x1b[K");
}

void Progress::update(std::size_t done) {
  using namespace std::chrono_literals;
  const auto now = Clock::now();
  if (now - printed_ < (terminal_ ? Clock::duration(200ms) : Clock::duration(10s))) return;
  printed_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double rate = static_cast<double>(done) / seconds;
  const double left = rate > 0 ? static_cast<double>(total_ - done) / rate : 0;
  fmt::print(stderr, "{}{} of {} {}, {:.0f}/s, {:.0f} s left{}", terminal_ ? "\r" : "", done,
             total_, unit_, rate, left, terminal_ ? "\x1b[K" : "\n");
  std::fflush(stderr);
}

}  // namespace touchstone
