#include "candidates/host/command_process.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <optional>
#include <poll.h>
#include <signal.h>
#include <string_view>
#include <sys/socket.h>
#include <unistd.h>
#include <utility>

#include "candidates/host/exchange.hpp"
#include "candidates/host/guard.hpp"
#include "candidates/readable.hpp"

namespace touchstone {
namespace {

using Clock = std::chrono::steady_clock;

/// Interval at which a child's use of time is checked.
constexpr std::chrono::milliseconds request_check_interval(10);
/// Waiting by the clock where the kernel does not distinguish it from waiting for a processor, as a
/// multiple of what is allowed.
constexpr double waiting_clock_factor = 10;
/// A line longer than this is no answer.
constexpr std::size_t max_line = std::size_t{1} << 26;

/// Writes as much as the pipe takes; returns how much. All, if nobody will read it: what that means
/// is learnt from the child's end or its silence.
std::size_t write_to_pipe(int file, std::string_view text) {
  // Writing to a pipe that is closed raises a signal besides the error.
  sigset_t broken_pipe, before;
  sigemptyset(&broken_pipe);
  sigaddset(&broken_pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &broken_pipe, &before);
  const ssize_t written = write(file, text.data(), text.size());
  const bool is_broken = written < 0 && errno == EPIPE;
  constexpr timespec now{0, 0};
  if (is_broken && sigismember(&before, SIGPIPE) == 0) sigtimedwait(&broken_pipe, nullptr, &now);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (is_broken) return text.size();
  return written > 0 ? static_cast<std::size_t>(written) : 0;
}

}  // namespace

CommandProcess::CommandProcess(std::string command, std::filesystem::path folder)
    : command_(std::move(command)), folder_(std::move(folder)) {}

messages::Hello CommandProcess::start(std::chrono::milliseconds time) {
  stop();
  clear_text();
  int to_child[2], from_child[2];
  if (pipe2(to_child, O_CLOEXEC) != 0 || pipe2(from_child, O_CLOEXEC) != 0) fail("pipe2");
  input_ = to_child[1];
  output_ = from_child[0];
  fcntl(input_, F_SETFL, O_NONBLOCK);
  fcntl(output_, F_SETFL, O_NONBLOCK);
  start_host({command_, folder_.string()}, {to_child[0], from_child[1], text_});
  for (const int theirs : {to_child[0], from_child[1]}) close(theirs);

  const double seconds = std::chrono::duration<double>(time).count();
  const std::string line =
      ask(messages::hello() + '\n', 0, {seconds, seconds, std::numeric_limits<double>::infinity()});
  try {
    return messages::read_hello(line);
  } catch (const messages::Garbage& garbage) {
    refuse(garbage.what());
  }
}

void CommandProcess::stop() {
  HostProcess::stop();
  for (int* const file : {&input_, &output_}) {
    if (*file >= 0) close(std::exchange(*file, -1));
  }
  received_.clear();
}

std::string CommandProcess::ask(const std::string& request, std::size_t size,
                                const Allowance& allowance) {
  // Most answers come before the first check; the watch starts with that.
  std::optional<Watch> watching;
  auto next_check = Clock::now() + request_check_interval;
  std::size_t sent = 0;
  received_.clear();
  bool is_closed = false;
  for (;;) {
    std::array<pollfd, 3> polled = {pollfd{is_closed ? -1 : output_, POLLIN, 0},
                                    pollfd{socket_, POLLIN, 0},
                                    pollfd{sent < request.size() ? input_ : -1, POLLOUT, 0}};
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(next_check - Clock::now());
    poll(polled.data(), polled.size(), std::max(0, static_cast<int>(left.count())));

    if (polled[2].revents != 0) {
      sent += write_to_pipe(input_, std::string_view(request).substr(sent));
    }
    if (polled[0].revents != 0) {
      std::array<char, 1 << 16> piece;
      const ssize_t got = read(output_, piece.data(), piece.size());
      if (got > 0) received_.append(piece.data(), static_cast<std::size_t>(got));
      is_closed = got == 0;
      const std::size_t end = size > 0 ? size : received_.find('\n') + 1;
      const bool is_whole = end > 0 && received_.size() >= end;
      if (is_whole && received_.size() > end) {
        refuse("it wrote more than its answer: " + messages::quoted(received_));
      }
      if (is_whole && sent < request.size()) refuse("it answered before it was asked");
      if (is_whole) {
        received_.resize(size > 0 ? size : end - 1);
        return std::move(received_);
      }
      if (size >= sizeof(std::uint32_t) && received_.size() >= sizeof(std::uint32_t)) {
        std::uint32_t length;
        std::memcpy(&length, received_.data(), sizeof length);
        if (length != size - sizeof length) {
          refuse("its frame's length is " + std::to_string(length) + " instead of " +
                 std::to_string(size - sizeof length));
        }
      }
      if (received_.size() > max_line) refuse("its line is too long");
      if (is_closed && (polled[1].revents == 0)) {
        // Give the guard the time to say how the child ended.
        pollfd end_of_child{socket_, POLLIN, 0};
        if (poll(&end_of_child, 1, 100) <= 0) {
          give_up(TS_CRASHED, received_.empty() ? "closed its standard output"
                                                : "closed its standard output within a message");
        }
        ended();
      }
    } else if (polled[1].revents != 0) {
      ended();
    }
    if (Clock::now() < next_check) continue;
    next_check = Clock::now() + request_check_interval;
    if (!watching) watching.emplace(watch());
    const Watch::TimeUse spent = watching->spent();
    if (spent.computing > allowance.processor_seconds) {
      give_up(TS_TIMED_OUT, "no answer within " + seconds_text(allowance.processor_seconds));
    }
    if (spent.waiting.value_or(spent.by_the_clock / waiting_clock_factor) >
        allowance.waiting_seconds) {
      give_up(TS_TIMED_OUT,
              "no answer, having waited for " + seconds_text(allowance.waiting_seconds));
    }
    if (watching->resident_mebibytes() > allowance.mebibytes) {
      char text[80];
      std::snprintf(text, sizeof text, "used more than %.0f MiB of memory", allowance.mebibytes);
      give_up(TS_CRASHED, text);
    }
  }
}

void CommandProcess::give_up(ts_status status, std::string reason) {
  stop();
  const std::string line = last_line();
  if (!line.empty()) reason += "; standard error: " + line;
  throw NoAnswer{status, readable(reason)};
}

void CommandProcess::refuse(const std::string& why) {
  give_up(TS_CRASHED, "wrote what is no answer: " + why);
}

void CommandProcess::ended() {
  Reply reply{};
  const bool told = recv(socket_, &reply, sizeof reply, 0) == sizeof reply;
  give_up(TS_CRASHED, told ? how_it_ended(reply.value) : "ended");
}

}  // namespace touchstone
