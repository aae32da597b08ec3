#pragma once

namespace touchstone {

/// Gives the processes that are forked from now on a PID namespace of their own, where the system
/// lets us: from inside it no process outside can be named, so none can be signalled, and all that
/// is inside ends with its first process (pid_namespaces(7)). False where it may not be, as for
/// root without CAP_SYS_ADMIN in most containers. Only for a process with one thread.
bool begin_pid_namespace();

/// Forks and returns in the child alone. The parent becomes the child's guard: it runs nothing but
/// this function, and when the child ends or is stopped, or when it is sent SIGTERM, which it also
/// is when its own parent ends, it kills all processes that descend from the child and ends. On
/// `socket`, unless that is -1, it reports that the child is gone, with its wait status.
///
/// The child leads a process group of its own: signals for a group or from a terminal stay on
/// either side. (No session of its own: Linux hands out processors by turns of sessions,
/// sched_autogroup in sched(7), and every answer would wait for such a turn.)
void fork_guarded(int socket);

}  // namespace touchstone
