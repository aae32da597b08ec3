#include "candidates/host/spoken_command.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <poll.h>
#include <signal.h>
#include <stdexcept>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>
#include <utility>

#include <Eigen/Geometry>

#include "candidates/host/guard.hpp"

/// Shapes that the child has prepared.
struct ts_prepared {
  touchstone::SpokenCommand& command;
  std::uint32_t handle;
  double model_distance;  ///< of the last query; NaN if unknown
  touchstone::messages::Prepared as;
};

namespace touchstone {
namespace {

/// A line longer than this is no answer.
constexpr std::size_t max_line = std::size_t{1} << 26;
/// Time for a child that has closed its output to end, while the time for an answer runs; and for
/// one that has not said what it is, on a busy machine, too.
constexpr int max_milliseconds_to_end = 100, max_milliseconds_to_fail = 5000;
/// Shapes that are released together: telling the child takes as long as an answer.
constexpr std::size_t max_released = 64;

/// Seconds of one pass, beyond the first min_timed_questions questions, and of one round.
constexpr double max_pass = 5e-4, min_round = 2e-3;
constexpr std::size_t min_timed_questions = 10;
constexpr std::uint32_t max_passes = 1u << 20;
constexpr int max_warm_rounds = 30;
constexpr double steady = 0.05;  ///< relative difference of three rounds of a warm child

/// Is this a program and its arguments alone, so that the shell can become the program?
bool is_simple(const std::string& command) {
  const bool has_operator = command.find_first_of(";&|<>(){}\n`") != std::string::npos;
  const bool has_assignment = command.substr(0, command.find(' ')).find('=') != std::string::npos;
  return !has_operator && !has_assignment;
}

/// An upper bound of a shape's extent from its origin; that of a plane's displacement.
double extent(const ts_shape& shape) {
  double sum = 0, largest = 0;
  for (const double size : shape.size) sum += std::abs(size);
  for (const double x : coordinates_of(shape)) largest = std::max(largest, std::abs(x));
  return sum + 3 * largest;
}

/// The poses with body A so far from B that every broad phase tells them apart: along +x, or along
/// a plane's normal.
messages::Poses moved_apart(messages::Poses poses, const ts_shape& a, const ts_shape& b) {
  const double distance = 1e3 * (extent(a) + extent(b));
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  if (b.kind == TS_PLANE) {
    const double* const q = poses.b.orientation;
    direction = Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * Eigen::Vector3d(b.size);
  }
  for (int i = 0; i < 3; ++i) {
    poses.a.position[i] += distance * direction[i] + (poses.b.position[i] - poses.a.position[i]);
  }
  return poses;
}

}  // namespace

SpokenCommand::SpokenCommand(const char* line, const char* folder) {
  int to_child[2], from_child[2];
  if (pipe2(to_child, O_CLOEXEC) != 0 || pipe2(from_child, O_CLOEXEC) != 0 ||
      (child_ = fork()) < 0) {
    fail("fork");
  }
  if (child_ == 0) {
    dup2(to_child[0], STDIN_FILENO);
    dup2(from_child[1], STDOUT_FILENO);
    run(line, folder);
  }
  close(to_child[0]);
  close(from_child[1]);
  input_ = to_child[1];
  output_ = from_child[0];
  end_ = static_cast<int>(syscall(SYS_pidfd_open, child_, 0));
  signal(SIGPIPE, SIG_IGN);  // what nobody reads is learnt from the child's end or its silence
  description_ = messages::read_hello(ask(messages::hello() + '\n', 0));
  has_spoken_ = true;
  description_.unforked = true;
  if (description_.in_frames) format_ = messages::Format::frames;
}

void SpokenCommand::run(const char* line, const char* folder) const {
  become_plain_process(max_file);
  if (chdir(folder) != 0) {
    std::perror(folder);
    _exit(126);
  }
  // Without a shell in between the end of the command's output is seen at once.
  const std::string text = is_simple(line) ? std::string("exec ") + line : line;
  execl("/bin/sh", "sh", "-c", text.c_str(), static_cast<char*>(nullptr));
  _exit(127);
}

std::string SpokenCommand::ask(const std::string& request, std::size_t size) {
  for (std::size_t sent = 0; sent < request.size();) {
    const ssize_t written = write(input_, request.data() + sent, request.size() - sent);
    if (written < 0 && errno != EINTR) break;
    sent += static_cast<std::size_t>(std::max<ssize_t>(written, 0));
  }
  for (std::string received;;) {
    std::array<pollfd, 2> polled = {pollfd{output_, POLLIN, 0}, pollfd{end_, POLLIN, 0}};
    if (poll(polled.data(), polled.size(), -1) < 0) continue;
    std::array<char, 1 << 16> piece;
    const ssize_t got = polled[0].revents ? read(output_, piece.data(), piece.size()) : 0;
    if (got <= 0) ended(!received.empty());
    received.append(piece.data(), static_cast<std::size_t>(got));
    const std::size_t end = size > 0 ? size : received.find('\n') + 1;
    if (end > 0 && received.size() > end) {
      throw messages::Garbage("it wrote more than its answer: " + messages::quoted(received));
    }
    if (end > 0 && received.size() == end) return received.substr(0, size > 0 ? end : end - 1);
    if (std::uint32_t length; size > 0 && received.size() >= sizeof length) {
      std::memcpy(&length, received.data(), sizeof length);
      if (length != size - sizeof length) {
        throw messages::Garbage("its frame's length is " + std::to_string(length) + " instead of " +
                                std::to_string(size - sizeof length));
      }
    }
    if (received.size() > max_line) throw messages::Garbage("its line is too long");
  }
}

void SpokenCommand::ended(bool within_message) const {
  pollfd end{end_, POLLIN, 0};
  int status = 0;
  const int time = has_spoken_ ? max_milliseconds_to_end : max_milliseconds_to_fail;
  if (poll(&end, 1, time) > 0 && waitpid(child_, &status, 0) == child_) {
    throw std::runtime_error(how_it_ended(status));
  }
  throw std::runtime_error(std::string("closed its standard output") +
                           (within_message ? " within a message" : ""));
}

std::string SpokenCommand::ask(const messages::Request& request) {
  return ask(request.text, request.answer_size());
}

ts_candidate SpokenCommand::candidate() {
  ts_candidate candidate{};
  candidate.context = this;
  candidate.supports = [](void* context, ts_shape_kind other) -> int {
    return static_cast<SpokenCommand*>(context)->description_.supports[other];
  };
  candidate.prepare = [](void* context, const ts_shape* a, const ts_shape* b, double threshold,
                         double parameter) {
    return static_cast<SpokenCommand*>(context)->prepare(*a, *b, threshold, parameter);
  };
  candidate.query = [](ts_prepared* prepared, const ts_pose* a, const ts_pose* b,
                       const double* hint, ts_answer* answer) {
    messages::Poses poses{prepared->handle, *a, *b, hint != nullptr, {}};
    if (hint) std::copy(hint, hint + 3, poses.previous_normal);
    const Answer given = prepared->command.query(poses);
    *answer = static_cast<const ts_answer&>(given);
    prepared->model_distance =
        given.model_distance.value_or(std::numeric_limits<double>::quiet_NaN());
  };
  candidate.release = [](ts_prepared* prepared) {
    prepared->command.release(prepared->handle);
    delete prepared;
  };
  candidate.model_distance = [](ts_prepared* prepared, const ts_pose*, const ts_pose*) {
    return prepared->model_distance;
  };
  return candidate;
}

Roundings SpokenCommand::roundings() const {
  if (!description_.says_roundings) return nullptr;
  return [](const ts_prepared* prepared, double* of_a, double* of_b) {
    *of_a = prepared->as.roundings[0];
    *of_b = prepared->as.roundings[1];
  };
}

ts_prepared* SpokenCommand::prepare(const ts_shape& a, const ts_shape& b, double threshold,
                                    double parameter) {
  const messages::PairOfShapes pair{next_handle_++, threshold, parameter, a, b};
  const auto request =
      messages::prepare_request(format_, ++ticket_, pair, description_.says_roundings);
  if (const auto prepared = messages::read_prepared(request, ask(request))) {
    return new ts_prepared{*this, pair.handle, std::numeric_limits<double>::quiet_NaN(), *prepared};
  }
  release(pair.handle);
  return nullptr;
}

Answer SpokenCommand::query(const messages::Poses& poses) {
  const auto request = messages::query_request(format_, ++ticket_, {&poses, 1});
  return messages::read_answer(request, ask(request));
}

std::optional<ts_cast> SpokenCommand::cast(const ts_shape& a, const ts_shape& b, double parameter,
                                           const messages::Poses& poses) {
  ts_prepared* const prepared = prepare(a, b, 0, parameter);
  if (!prepared) return ts_cast{TS_CAST_UNSUPPORTED, 0, {}};
  messages::Poses of_prepared = poses;
  of_prepared.handle = prepared->handle;
  const auto request = messages::cast_request(format_, ++ticket_, of_prepared);
  const auto answer = messages::read_cast(request, ask(request));
  release(prepared->handle);
  delete prepared;
  return answer;
}

void SpokenCommand::release(std::uint32_t handle) {
  released_.push_back(handle);
  if (released_.size() < max_released) return;
  const auto request = messages::release_request(format_, ++ticket_, std::exchange(released_, {}));
  messages::read_released(request, ask(request));
}

void SpokenCommand::warm_up(double parameter) {
  const ts_candidate spoken = candidate();
  static constexpr double corners[] = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
  static constexpr int faces[] = {3, 0, 1, 2, 3, 0, 2, 1};
  constexpr ts_shape triangle{TS_CONVEX, {}, corners, faces, 3, 2, 0};
  for (const ts_shape_kind kind :
       {TS_SPHERE, TS_BOX, TS_CYLINDER, TS_CAPSULE, TS_PLANE, TS_CONVEX}) {
    if (!description_.supports[kind]) continue;
    const ts_shape a = sized(TS_CYLINDER, 0.5, 0.5);
    const ts_shape b = kind == TS_PLANE    ? sized(kind, 0, 0, 1)
                       : kind == TS_CONVEX ? triangle
                                           : sized(kind, 0.5, 0.5, 0.5);
    const ts_pose pose_a{{0, 0.1, 0.4}, {0.8, 0.6, 0, 0}}, pose_b{{0, 0, 0}, {1, 0, 0, 0}};
    ts_prepared* const prepared = prepare(a, b, 0, parameter);
    if (!prepared) return;
    ts_answer answer;
    spoken.query(prepared, &pose_a, &pose_b, nullptr, &answer);
    return spoken.release(prepared);
  }
}

double SpokenCommand::time(std::span<const messages::Poses> poses, std::uint32_t passes) {
  const auto request = messages::query_request(format_, ++ticket_, poses, passes);
  return messages::read_time(request, ask(request));
}

double SpokenCommand::warm_cost(std::span<const messages::Poses> poses,
                                const std::function<void()>& step) {
  std::array<double, 3> last{};
  for (int i = 0; i < max_warm_rounds; ++i) {
    step();
    std::rotate(last.begin(), last.begin() + 1, last.end());
    last.back() = time(poses, passes_) / (passes_ * static_cast<double>(poses.size()));
    const auto [min, max] = std::minmax_element(last.begin(), last.end());
    if (i >= 2 && *max <= (1 + steady) * *min) break;
  }
  std::sort(last.begin(), last.end());
  return last[1];
}

void SpokenCommand::prepare_timing(std::span<const Question> questions, double parameter,
                                   const std::function<void()>& step) {
  for (const messages::Poses& poses : std::exchange(timed_, {})) release(poses.handle);
  std::vector<messages::Poses> apart;
  for (const Question& q : questions) {
    step();
    ts_prepared* const prepared = prepare(q.a, q.b, q.threshold, parameter);
    if (!prepared) continue;
    timed_.push_back({prepared->handle, q.pose_a, q.pose_b, false, {}});
    apart.push_back(moved_apart(timed_.back(), q.a, q.b));
    delete prepared;  // its shapes stay prepared until they are timed no more
  }
  if (timed_.empty()) return;

  // As many as take half a millisecond, by the time of the first ones.
  const std::size_t first = std::min(min_timed_questions, timed_.size());
  step();
  const double each =
      std::max(1e-9 * time(std::span(timed_).first(first), 1), 1e-9) / static_cast<double>(first);
  const auto count = std::clamp(static_cast<std::size_t>(max_pass / each), first, timed_.size());
  for (std::size_t i = count; i < timed_.size(); ++i) release(timed_[i].handle);
  timed_.resize(count);
  apart.resize(count);

  for (passes_ = 1; passes_ < max_passes; passes_ *= 2) {
    step();
    if (1e-9 * time(timed_, passes_) >= min_round) break;
  }
  floor_ = warm_cost(apart, step);
  warm_cost(timed_, step);
}

void SpokenCommand::time(std::uint32_t rounds, Exchange& exchange) {
  exchange.queries = static_cast<double>(rounds) * passes_ * static_cast<double>(timed_.size());
  exchange.nanoseconds = timed_.empty() ? std::numeric_limits<double>::quiet_NaN()
                                        : time(timed_, rounds * passes_) / exchange.queries;
  exchange.instructions = exchange.tail_nanoseconds = std::numeric_limits<double>::quiet_NaN();
  exchange.floor = floor_;
}

}  // namespace touchstone
