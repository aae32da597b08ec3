#pragma once

#include <string>
#include <sys/types.h>

namespace touchstone {

/// Gives the processes forked from now on a PID namespace of their own, if the system allows it:
/// from inside, no process outside can be named or signalled, and all processes inside end with the
/// first one (pid_namespaces(7)). False if it is not permitted, as for root without CAP_SYS_ADMIN
/// in most containers. Precondition: this process has a single thread.
bool begin_pid_namespace();

/// Forks, and returns in the child only. The parent becomes the child's guard and runs nothing
/// else. When the child ends or is stopped, or on SIGTERM (which the guard also gets when its own
/// parent ends), the guard kills all descendants of the child and exits. On `socket`, unless it is
/// -1, it reports that the child has ended, with its wait status (Reply::gone of exchange.hpp).
///
/// The child leads a process group of its own, so that signals to a group or from a terminal do not
/// cross. (Not a session of its own: Linux schedules sessions in turn, see sched_autogroup in
/// sched(7), and every answer would wait for its turn.)
void fork_guarded(int socket);

/// Undoes in a guarded process what a program should not inherit: blocked and ignored signals, core
/// files. What it writes to one file is limited to `max_file` bytes.
void become_plain_process(unsigned long max_file);

/// The last line of what such a process has printed to a file, without its end.
std::string last_line(int file);

/// "Segmentation fault", "ended with exit code 3": how a process of this wait status ended.
std::string how_it_ended(int wait_status);

/// Throws std::system_error of errno.
[[noreturn]] void fail(const char* call);

/// Ends a guard that this process has forked, with all that it guards, and waits for its end.
void end_guard(pid_t guard);

}  // namespace touchstone
