// Times a command by its own clock, and compares that with ours.
#include <algorithm>
#include <array>
#include <cmath>

#include "candidates/host/command_respondent.hpp"

namespace touchstone {
namespace {

/// Seconds of one pass, beyond the first min_timed questions.
constexpr double max_timed_seconds = 5e-4;
constexpr std::size_t min_timed = 10;
constexpr std::uint32_t max_passes = 1u << 20;
constexpr int max_warm_rounds = 30;
constexpr int clock_rounds = 3;
constexpr double max_ratio = 1e6;  ///< of clocks
constexpr double steady = 0.05;    ///< relative difference of three rounds of a warm child

/// An upper bound of a shape's extent from its centre; that of a plane's displacement.
double extent(const ts_shape& shape) {
  double sum = 0;
  for (const double size : shape.size) sum += std::abs(size);
  return sum;
}

/// The poses with body A so far from B that every broad phase tells them apart: along +x, or along
/// a plane's normal.
messages::Poses moved_apart(messages::Poses poses, const ts_shape& a, const ts_shape& b) {
  const double distance = 1e3 * (extent(a) + extent(b));
  Vec3 direction(1, 0, 0);
  if (b.kind == TS_PLANE) {
    const double* const q = poses.b.orientation;
    direction = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Vec3(b.size[0], b.size[1], b.size[2]);
  }
  for (int i = 0; i < 3; ++i) {
    poses.a.position[i] += distance * direction[i] + (poses.b.position[i] - poses.a.position[i]);
  }
  return poses;
}

}  // namespace

double CommandRespondent::warm_cost(const std::vector<messages::Poses>& poses) {
  std::array<double, 3> last{};
  for (int i = 0; i < max_warm_rounds; ++i) {
    std::rotate(last.begin(), last.begin() + 1, last.end());
    last.back() = time(poses, passes_) / (passes_ * static_cast<double>(poses.size()));
    const auto [min, max] = std::minmax_element(last.begin(), last.end());
    if (i >= 2 && *max <= (1 + steady) * *min) break;
  }
  std::sort(last.begin(), last.end());
  return last[1];
}

bool CommandRespondent::prepare_timing(std::span<const Asked> asked) try {
  end_session();
  timed_.clear();
  measured_.reset();
  start();
  // Handles stay prepared until the next call, however many.
  const std::vector<Question> questions = questions_of(asked);
  std::vector<messages::Poses> apart;
  for (std::size_t at = 0; at < questions.size(); at += batch_size) {
    const auto batch = std::span(questions).subspan(at).first(
        std::min<std::size_t>(batch_size, questions.size() - at));
    const auto prepared = prepare(batch);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      if (!prepared[i]) continue;
      timed_.push_back(*prepared[i]);
      apart.push_back(moved_apart(*prepared[i], batch[i].a, batch[i].b));
    }
  }
  if (timed_.empty()) return false;

  // As many as take half a millisecond, by the time of the first ones.
  const std::size_t first = std::min(min_timed, timed_.size());
  const std::vector some(timed_.begin(), timed_.begin() + static_cast<std::ptrdiff_t>(first));
  const double each = std::max(1e-9 * time(some, 1), 1e-9) / static_cast<double>(first);
  const auto count =
      std::clamp(static_cast<std::size_t>(max_timed_seconds / each), first, timed_.size());
  timed_.resize(count);
  apart.resize(count);

  for (passes_ = 1; passes_ < max_passes; passes_ *= 2) {
    if (1e-9 * time(timed_, passes_) >= min_round) break;
  }
  const double floor = warm_cost(apart);
  warm_cost(timed_);
  measured_ = compare_clocks(floor);
  return true;
} catch (const NoAnswer&) {
  return false;
}

QueryCost::Measured CommandRespondent::compare_clocks(double floor) {
  // What a request costs besides its queries is in both of two rounds of different length.
  double told = 0, ours = 0, computing = 0;
  for (int i = 0; i < clock_rounds; ++i) {
    for (const int sign : {-1, 1}) {
      const Watch watch = process_.watch();
      told += sign * 1e-9 * time(timed_, sign > 0 ? 2 * passes_ : passes_);
      const Watch::TimeUse spent = watch.spent();
      ours += sign * spent.by_the_clock;
      computing += sign * spent.computing;
    }
  }
  ours = std::max(ours, 0.0);  // a busy machine may make the longer round the faster one
  computing = std::max(computing, 0.0);
  told = std::max({told, ours / max_ratio, 1e-12});  // of a child that tells nothing
  return {floor, ours / told, computing / told};
}

std::optional<QueryCost> CommandRespondent::cost_per_query() try {
  if (!measured_ || !process_.runs()) return std::nullopt;
  const double queries = passes_ * static_cast<double>(timed_.size());
  QueryCost cost{std::max(time(timed_, passes_), 1.0) / queries, std::nullopt};
  cost.measured = measured_;
  return cost;
} catch (const NoAnswer&) {
  return std::nullopt;
}

}  // namespace touchstone
