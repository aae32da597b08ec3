#include "candidates/host/time_limits.hpp"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

/// The lower limit of processor time of a candidate that has exceeded the full one, and beyond
/// which a configuration is asked again alone: a multiple of the median of its answers, but at
/// least a share of the full one. So many answers must be known, or so many must have timed out: of
/// a candidate that hardly ever answers, the median is never well known. The few answers that are
/// known then came first in their sessions, where they take ten times as long.
constexpr double median_factor = 100, first_median_factor = 10, min_share = 0.1;
constexpr std::size_t min_known = 15, max_known = 255;
constexpr int many_timeouts = 3;

/// Multiples of the limit of processor time: how long a query may wait at first, and how long it
/// may take by the clock if the kernel does not distinguish waiting for something from waiting for
/// a processor.
constexpr double initial_wait_factor = 10, clock_factor = 100;

}  // namespace

void TimeLimits::forget() {
  max_wait_ = initial_wait_factor * full_;
  learnt_.clear();
  timeouts_ = 0;
}

void TimeLimits::learn(double seconds) {
  if (learnt_.size() < max_known && std::isfinite(seconds)) learnt_.push_back(seconds);
}

TimeLimits::Limit TimeLimits::full() const {
  return {full_, "no answer within " + seconds_text(full_)};
}

TimeLimits::Limit TimeLimits::lowered(const std::vector<double>& latest, bool on_suspicion) const {
  if (!are_lowered_ || (timeouts_ == 0 && !on_suspicion)) return full();
  std::vector<double> known = learnt_;
  std::copy_if(latest.begin(), latest.end(), std::back_inserter(known),
               [](double seconds) { return std::isfinite(seconds); });
  const bool are_few = known.size() < min_known;
  if (are_few && timeouts_ < many_timeouts) return full();
  const double least = min_share * full_;
  const std::string reason = "no answer within " + seconds_text(least);
  if (known.empty()) return {least, reason + ", as others within " + seconds_text(full_)};
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::nth_element(known.begin(), middle, known.end());
  const double limit = (are_few ? first_median_factor : median_factor) * *middle;
  if (limit >= full_) return full();
  // Without the number, which is measured and differs from run to run.
  return {std::max(least, limit),
          reason + " and " + (are_few ? "ten" : "a hundred") + " times its median"};
}

std::string TimeLimits::waited_too_long(const Watch& watch, double configurations) {
  const double max_wait = configurations * max_wait_,
               max_time = configurations * clock_factor * full_;
  const Watch::TimeUse spent = watch.spent();
  if (!spent.waiting && spent.by_the_clock > max_time) {
    return "no answer within " + seconds_text(max_time) + " by the clock";
  }
  if (spent.waiting.value_or(0) <= max_wait) return "";
  if (are_lowered_) max_wait_ = std::max(full_, max_wait_ / 2);
  return "no answer, having waited for " + seconds_text(max_wait);
}

}  // namespace touchstone
