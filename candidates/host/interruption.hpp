#pragma once

namespace touchstone {

/// While one lives, the first SIGINT (Ctrl-C) or SIGTERM only asks for an end, which long work
/// answers with what there is by then; a second one ends the program at once. A signal that was
/// ignored when the program began stays so. One at a time.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
};

/// Has an end been asked for? Never without an Interruption.
bool interrupted();

int interrupting_signal();  ///< SIGINT or SIGTERM; zero if there was none

/// As shells count it, 128 and the signal: 130 after Ctrl-C, 143 after SIGTERM.
int interrupted_exit_code();

}  // namespace touchstone
