#include "candidates/host/interruption.hpp"

#include <cstring>
#include <ctime>
#include <iterator>
#include <signal.h>
#include <unistd.h>

namespace touchstone {
namespace {

volatile sig_atomic_t asked = 0;
timespec when_asked;
pid_t told_of;  ///< the process that says what it loses
constexpr int signals[] = {SIGINT, SIGTERM, SIGHUP};
constexpr std::size_t signal_count = std::size(signals);
struct sigaction previous[signal_count];

// All that handlers call is async-signal-safe.

void say(const char* text) {
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

void end_at_once(int signal) {
  ::signal(signal, SIG_DFL);
  raise(signal);  // takes effect when the handler returns
}

/// One request may come as several signals, of `timeout` for example; at a logout SIGHUP comes with
/// SIGTERM.
bool is_the_same_request(int signal) {
  constexpr double at_least = 0.3;  // seconds between two requests of a person
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const double passed = static_cast<double>(now.tv_sec - when_asked.tv_sec) +
                        1e-9 * static_cast<double>(now.tv_nsec - when_asked.tv_nsec);
  const bool is_of_one_kind = signal == asked || signal == SIGHUP || asked == SIGHUP;
  return is_of_one_kind && passed < at_least;
}

void on_signal(int signal) {
  if (asked) {
    if (!is_the_same_request(signal)) end_at_once(signal);
    return;
  }
  asked = signal;
  clock_gettime(CLOCK_MONOTONIC, &when_asked);
  say("\ntouchstone: ending with what there is; once more ends at once\n");
}

void on_unexpected_signal(int signal) {
  // Below a line of progress.
  if (getpid() == told_of) say("\ntouchstone: interrupted; only what was written before is kept\n");
  end_at_once(signal);
}

void handle(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;  // without SA_RESTART: waiting calls return
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < signal_count; ++i) {
    sigaction(signals[i], nullptr, &previous[i]);
    if (previous[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);
  }
}

}  // namespace

Interruption::Interruption() {
  asked = 0;
  handle(on_signal);
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < signal_count; ++i) sigaction(signals[i], &previous[i], nullptr);
  asked = 0;
}

void say_when_interrupted() {
  told_of = getpid();
  handle(on_unexpected_signal);
}

bool interrupted() { return asked != 0; }
int interrupting_signal() { return asked; }
int interrupted_exit_code() { return 128 + asked; }

}  // namespace touchstone
