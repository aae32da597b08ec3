#include "candidates/host/interruption.hpp"

#include <cstring>
#include <signal.h>
#include <unistd.h>

namespace touchstone {
namespace {

volatile sig_atomic_t asked = 0;
struct sigaction previous[2];
constexpr int signals[] = {SIGINT, SIGTERM};

void on_signal(int signal) {
  if (asked) {
    ::signal(signal, SIG_DFL);
    raise(signal);  // takes effect when this handler returns
    return;
  }
  asked = signal;
  constexpr char text[] = "\ntouchstone: ending with what there is; once more ends at once\n";
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, text, std::strlen(text));
}

}  // namespace

Interruption::Interruption() {
  asked = 0;
  struct sigaction action {};
  action.sa_handler = on_signal;  // without SA_RESTART: waiting calls return
  sigemptyset(&action.sa_mask);
  for (int i = 0; i < 2; ++i) {
    sigaction(signals[i], nullptr, &previous[i]);
    if (previous[i].sa_handler != SIG_IGN) sigaction(signals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (int i = 0; i < 2; ++i) sigaction(signals[i], &previous[i], nullptr);
  asked = 0;
}

bool interrupted() { return asked != 0; }
int interrupting_signal() { return asked; }
int interrupted_exit_code() { return 128 + asked; }

}  // namespace touchstone
