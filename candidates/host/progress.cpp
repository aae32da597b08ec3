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

const OverallProgress* overall = nullptr;

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

std::string overall_text(double share, double seconds, const std::string& part) {
  constexpr std::size_t width = 20;
  constexpr double min_share = 0.01;  // of which a rate can be told
  const auto filled = static_cast<std::size_t>(share * width);
  std::string bar(filled, '=');
  if (filled < width) bar += '>';
  bar.resize(width, ' ');
  const std::string left =
      share >= min_share ? fmt::format(", {} left", time_text(seconds * (1 - share) / share)) : "";
  return fmt::format("[{}] {:.0f}%{}: {}", bar, std::floor(100 * share), left, part);
}

OverallProgress::OverallProgress(std::vector<Part> parts)
    : parts_(std::move(parts)), start_(std::chrono::steady_clock::now()) {
  double sum = 0;
  for (const Part& part : parts_) sum += part.share;
  for (Part& part : parts_) part.share /= sum;
  overall = this;
}

OverallProgress::~OverallProgress() { overall = nullptr; }

std::string OverallProgress::text(const std::string& unit, std::size_t done,
                                  std::size_t total) const {
  double share = 0;
  for (const Part& part : parts_) {
    if (part.unit == unit) {
      share +=
          part.share * (total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1);
      break;
    }
    share += part.share;
  }
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  return overall_text(std::min(share, 1.0), passed.count(),
                      fmt::format("{} of {} {}", done, total, unit));
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
  const std::string text =
      overall ? overall->text(unit_, done, total_) : progress_text(unit_, done, total_, seconds);
  if (terminal_) {
    std::fputs((clear_line + fitting(text)).c_str(), stderr);
  } else {
    std::fputs((text + '\n').c_str(), stderr);
  }
  std::fflush(stderr);
}

}  // namespace touchstone
