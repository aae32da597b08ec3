#include "campaigns/stop_signals.hpp"

#include <csignal>

namespace touchstone {
namespace {

volatile std::sig_atomic_t last = 0;

void keep(int signal) { last = signal; }

}  // namespace

StopSignals::StopSignals() {
  last = 0;
  std::signal(SIGINT, keep);
  std::signal(SIGTERM, keep);
}

StopSignals::~StopSignals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

int StopSignals::caught() const { return last; }

}  // namespace touchstone
