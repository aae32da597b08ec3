#include "candidates/host/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>
#include <utility>

namespace touchstone {
namespace {

using namespace std::chrono_literals;

constexpr std::chrono::milliseconds between_rewrites = 200ms;
constexpr std::chrono::seconds between_lines = 10s;
constexpr const char* clear_line = "\r\x1b[K";

std::string time_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

/// A line that wraps cannot be rewritten.
std::string fitting(const std::string& text) {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return text;
  return text.substr(0, size.ws_col - 1U);
}

}  // namespace

std::string progress_text(const std::string& unit, std::size_t done, std::size_t total,
                          double seconds) {
  std::string text = fmt::format("{} of {} {}", done, total, unit);
  if (done == 0 || !(seconds > 0)) return text;
  const double rate = static_cast<double>(done) / seconds;
  const double left = static_cast<double>(total - std::min(done, total)) / rate;
  return text + fmt::format(", {:.{}f}/s, {} left", rate, rate < 10 ? 1 : 0, time_text(left));
}

Progress::Progress(std::string unit, std::size_t total)
    : unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      printed_(start_) {}

Progress::~Progress() {
  if (terminal_) std::fputs(clear_line, stderr);
}

void Progress::update(std::size_t done) {
  const auto now = Clock::now();
  if (now - printed_ < (terminal_ ? Clock::duration(between_rewrites) : between_lines)) return;
  printed_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const std::string text = progress_text(unit_, done, total_, seconds);
  if (terminal_) {
    std::fputs((clear_line + fitting(text)).c_str(), stderr);
  } else {
    std::fputs((text + '\n').c_str(), stderr);
  }
  std::fflush(stderr);
}

}  // namespace touchstone
