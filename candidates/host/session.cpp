// One session of a candidate: prepares its shapes, asks it, and times it.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <exception>
#include <limits>
#include <linux/perf_event.h>
#include <optional>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "candidates/host/exchange.hpp"
#include "candidates/host/routine.hpp"
#include "candidates/host/spoken_command.hpp"

namespace touchstone {
namespace {

/// Counts the instructions that this process retires in user space, if machine and kernel allow it
/// (perf_event_open(2); kernel.perf_event_paranoid up to 2).
class InstructionCounter {
 public:
  InstructionCounter() {
    perf_event_attr attributes{};
    attributes.size = sizeof attributes;
    attributes.type = PERF_TYPE_HARDWARE;
    attributes.config = PERF_COUNT_HW_INSTRUCTIONS;
    attributes.disabled = 1;
    attributes.exclude_kernel = 1;
    attributes.exclude_hv = 1;
    constexpr int this_process = 0, any_processor = -1, no_group = -1;
    file_ = static_cast<int>(syscall(SYS_perf_event_open, &attributes, this_process, any_processor,
                                     no_group, PERF_FLAG_FD_CLOEXEC));
  }
  ~InstructionCounter() {
    if (file_ >= 0) close(file_);
  }
  InstructionCounter(const InstructionCounter&) = delete;
  InstructionCounter& operator=(const InstructionCounter&) = delete;

  void start() const {
    if (file_ < 0) return;
    ioctl(file_, PERF_EVENT_IOC_RESET, 0);
    ioctl(file_, PERF_EVENT_IOC_ENABLE, 0);
  }
  /// The count since start, within a few dozen; absent if instructions cannot be counted.
  std::optional<std::uint64_t> stop() const {
    if (file_ < 0) return std::nullopt;
    ioctl(file_, PERF_EVENT_IOC_DISABLE, 0);
    std::uint64_t count = 0;
    if (read(file_, &count, sizeof count) != sizeof count || count == 0) return std::nullopt;
    return count;
  }

 private:
  int file_;  ///< negative: not permitted
};

/// Upper limit of a round of timing, approximately, so that slow candidates do not take minutes.
constexpr std::chrono::microseconds max_round_time(500);
constexpr std::size_t min_timed = 10;
/// Lower limit of a round of timing, so that the caches' former content does not count.
constexpr std::chrono::microseconds min_round_time(200);

/// Processor time that this process has used, seconds.
double processor_seconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Keeps this process on one processor, unless it is -1.
void run_on(int processor) {
  if (processor < 0) return;
  cpu_set_t only;
  CPU_ZERO(&only);
  CPU_SET(processor, &only);
  sched_setaffinity(0, sizeof only, &only);
}

/// Tells what one answer after another took. Reading the clock of processor time takes a system
/// call, as long as many an answer; the steady clock takes none. A brief interval by the steady
/// clock has no room for waiting and counts as it is.
class LapClock {
 public:
  /// Seconds of processor time since the last lap, or since this was made.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> by_the_clock = now - std::exchange(last_, now);
    if (by_the_clock < max_brief) {
      brief_ += by_the_clock.count();
      return by_the_clock.count();
    }
    const double processor = processor_seconds();
    const double used = processor - std::exchange(processor_, processor);
    return std::max(0.0, used - std::exchange(brief_, 0));
  }

 private:
  static constexpr std::chrono::microseconds max_brief{50};

  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  double processor_ = processor_seconds();  ///< when that clock was read last
  double brief_ = 0;                        ///< seconds of brief laps since
};

double nanoseconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - start).count();
}

/// What reading the clock takes: an interval without anything in it.
double clock_nanoseconds() {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1000; ++i) {
    least = std::min(least, nanoseconds_since(std::chrono::steady_clock::now()));
  }
  return least;
}

/// Allocates the answer that a candidate fills. The page behind it is inaccessible, so that one
/// point too many is a crash, the same one on every run.
ts_answer* make_answer() {
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) _exit(1);
  char* const end = static_cast<char*>(memory) + page;
  mprotect(end, page, PROT_NONE);
  return reinterpret_cast<ts_answer*>(end - sizeof(ts_answer));
}

/// One candidate in a process of its own, which executes commands until it is told to finish or
/// dies.
class Session {
 public:
  Session(const ts_candidate& candidate, Roundings roundings, SpokenCommand* spoken,
          const SessionCommand& begin, int socket, const Questions& questions, Exchange& exchange);
  [[noreturn]] void serve();

 private:
  /// Prepared shapes and poses for timing.
  struct TimedQuery {
    ts_prepared* prepared;
    ts_pose a, b;
    double least = std::numeric_limits<double>::infinity();  ///< nanoseconds, of it alone
  };

  void obey(const SessionCommand& command);
  void answer(const SessionCommand& command);
  void answer(std::uint32_t slot);
  void forget_timed();
  void warm_up();
  void query_all();  ///< queries everything kept for timing once
  void time();
  double query_each();  ///< likewise, timing each of them singly; nanoseconds of all
  double tail() const;  ///< for Exchange::tail_nanoseconds

  Routine routine_;
  SpokenCommand* spoken_;  ///< null: a plug-in
  double parameter_;
  int socket_;
  const Questions& asked_;
  Exchange& exchange_;
  ts_answer* answer_;
  std::vector<Question> questions_;  ///< to be timed
  std::vector<OwnedShape> bodies_;   ///< their bodies B
  std::vector<TimedQuery> kept_;
  std::size_t passes_ = 1;                     ///< passes over kept_ in one timed round
  std::optional<InstructionCounter> counter_;  ///< once something is timed
  double clock_ = 0;  ///< nanoseconds that reading the clock takes, likewise
};

Session::Session(const ts_candidate& candidate, Roundings roundings, SpokenCommand* spoken,
                 const SessionCommand& begin, int socket, const Questions& questions,
                 Exchange& exchange)
    : routine_(candidate, roundings, begin.parameter),
      spoken_(spoken),
      parameter_(begin.parameter),
      socket_(socket),
      asked_(questions),
      exchange_(exchange),
      answer_(make_answer()) {
  reply(socket_, Reply::began, begin.ticket, 0);
}

void Session::serve() {
  const pid_t own = getpid();
  for (;;) {
    const SessionCommand command = receive(socket_);
    try {
      obey(command);
    } catch (const std::exception& e) {
      copy_text(e.what(), exchange_.text);
      _exit(exit_thrown);
    } catch (...) {
      copy_text("something that is no exception", exchange_.text);
      _exit(exit_thrown);
    }
    if (getpid() != own) _exit(0);  // a fork made by the candidate that returned like its parent
    reply(socket_, Reply::finished, command.ticket, 0);
  }
}

void Session::obey(const SessionCommand& command) {
  switch (command.kind) {
    case SessionCommand::answer:
      return answer(command);
    case SessionCommand::keep:
      run_on(command.processor);
      if (command.release) forget_timed();
      for (std::uint32_t i = 0; i < command.count; ++i) {
        Question& question = questions_.emplace_back(asked_.get(i));
        question.b = bodies_.emplace_back(question.b).get();
      }
      return;
    case SessionCommand::warm_up:
      if (!spoken_) return warm_up();
      return spoken_->prepare_timing(questions_, parameter_, [&] { ++exchange_.progress; });
    case SessionCommand::time:
      return spoken_ ? spoken_->time(command.count, exchange_) : time();
    case SessionCommand::begin:
    case SessionCommand::finish:
      _exit(0);
  }
}

void Session::answer(const SessionCommand& command) {
  if (command.forget) routine_.release_all();
  LapClock clock;
  for (std::uint32_t i = 0; i < command.count; ++i) {
    answer(i);
    // At once, so that a crash in release falls into the time of its own configuration.
    if (command.release) routine_.release_all_but_of(asked_, i + 1, command.count);
    exchange_.slots[i].seconds = clock.lap();
    exchange_.slots[i].seal = seal_of(exchange_.slots[i], command.ticket);
    exchange_.progress = progress_of(command.ticket, i + 1);
  }
}

void Session::answer(std::uint32_t i) {
  Slot& slot = exchange_.slots[i];
  slot.modelled = routine_.ask(asked_.get(i), *answer_);
  slot.answer = *answer_;
}

void Session::forget_timed() {
  for (const TimedQuery& k : kept_) routine_.candidate().release(k.prepared);
  kept_.clear();
  questions_.clear();
  bodies_.clear();
}

void Session::warm_up() {
  std::chrono::steady_clock::duration used{};
  for (const Question& q : questions_) {
    if (kept_.size() >= min_timed && used > max_round_time) break;
    ts_prepared* const prepared = routine_.prepare(q);
    if (!prepared) continue;
    const auto start = std::chrono::steady_clock::now();
    routine_.candidate().query(prepared, &q.pose_a, &q.pose_b, nullptr, answer_);
    used += std::chrono::steady_clock::now() - start;
    kept_.push_back({prepared, q.pose_a, q.pose_b});
  }
  const auto start = std::chrono::steady_clock::now();
  query_all();
  const auto once = std::max<std::chrono::steady_clock::duration>(
      std::chrono::steady_clock::now() - start, std::chrono::nanoseconds(1));
  passes_ = 1 + static_cast<std::size_t>(min_round_time / once);
}

void Session::query_all() {
  // The call goes through a function pointer, so that the optimiser cannot remove it.
  for (const TimedQuery& k : kept_)
    routine_.candidate().query(k.prepared, &k.a, &k.b, nullptr, answer_);
}

void Session::time() {
  if (!counter_) {
    counter_.emplace();
    clock_ = clock_nanoseconds();
  }
  query_all();  // warms the caches, as the process has slept since the last round
  const bool is_long = passes_ == 1;  // reading the clock after every query adds a hundredth
  counter_->start();
  const auto start = std::chrono::steady_clock::now();
  for (std::size_t pass = 0; pass < passes_ && !is_long; ++pass) query_all();
  const double together = nanoseconds_since(start);
  const double singly = is_long ? query_each() : 0;
  const auto instructions = counter_->stop();
  if (!is_long) query_each();
  const auto queries = exchange_.queries = static_cast<double>(passes_ * kept_.size());
  exchange_.nanoseconds = (is_long ? singly : together) / queries;
  exchange_.instructions = instructions ? static_cast<double>(*instructions) / queries
                                        : std::numeric_limits<double>::quiet_NaN();
  exchange_.tail_nanoseconds = tail();
}

double Session::query_each() {
  double sum = 0;
  for (TimedQuery& k : kept_) {
    const auto start = std::chrono::steady_clock::now();
    routine_.candidate().query(k.prepared, &k.a, &k.b, nullptr, answer_);
    const double nanoseconds = std::max(nanoseconds_since(start) - clock_, 0.0);
    k.least = std::min(k.least, nanoseconds);
    sum += nanoseconds;
  }
  return sum;
}

double Session::tail() const {
  if (kept_.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> times;
  for (const TimedQuery& k : kept_) times.push_back(k.least);
  // The least one that at least 95% do not exceed.
  const std::size_t rank = (95 * times.size() + 99) / 100 - 1;
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(rank), times.end());
  return times[rank];
}

}  // namespace

void serve_session(const ts_candidate& candidate, Roundings roundings, SpokenCommand* spoken,
                   const SessionCommand& begin, int socket, const Questions& questions,
                   Exchange& exchange) {
  Session(candidate, roundings, spoken, begin, socket, questions, exchange).serve();
}

}  // namespace touchstone
