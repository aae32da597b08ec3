#pragma once

namespace touchstone {

/// During its lifetime the first SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal has gone) only
/// requests an end, upon which long work returns its partial result; a second one, of the same kind
/// not within 0.3 s, ends the program at once. A signal that was ignored when the program began
/// stays ignored. There may be one object at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
};

/// From now on this process, where no Interruption catches these signals, says on standard
/// error that they end it.
void say_when_interrupted();

/// Has an end been requested? False without an Interruption.
bool interrupted();

int interrupting_signal();  ///< the signal received; otherwise zero

/// Exit code as shells define it, 128 plus the signal: 130 after Ctrl-C, 143 after SIGTERM, 129
/// after SIGHUP.
int interrupted_exit_code();

}  // namespace touchstone
