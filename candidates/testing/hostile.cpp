// A plug-in that attacks its host; for tests.
//
// hostile:N performs the N-th deed of the list below if A has the radius 7 (with
// TOUCHSTONE_HOSTILE_EVERYWHERE in the environment: always), and otherwise answers normally.
// TOUCHSTONE_HOSTILE_LOAD names a deed of the other list, which it performs when it is asked for
// its description. Harm to the machine is bounded.
#include "candidates/testing/hostile.hpp"

#include <cfenv>
#include <clocale>
#include <csetjmp>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <limits>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>
#include <xmmintrin.h>

#include "candidates/candidate.h"

namespace {

/// Zero, hidden from the compiler.
volatile std::uintptr_t nowhere = 0;
volatile double third = 0;

/// 1/3 in the current rounding mode.
void behave(ts_answer& answer, double x) {
  const double one = 1 + static_cast<double>(nowhere), three = 3 + static_cast<double>(nowhere);
  third = one / three;
  answer.status = TS_CONTACT;
  answer.signed_distance = -third - x;
  answer.point_count = 1;
  answer.points[0] = {{x, 0, 0}, {0, 0, 1}, third + x};
  std::memcpy(answer.normal, answer.points[0].normal, sizeof answer.normal);
}

/// Is this process in a PID namespace made by the host? Then it has two numbers, one in the host's
/// namespace and one in its own.
bool confined() {
  std::FILE* const status = std::fopen("/proc/self/status", "r");
  if (!status) return false;
  char line[256];
  int outer = 0, inner = 0, numbers = 0;
  while (numbers <= 0 && std::fgets(line, sizeof line, status)) {
    numbers = std::sscanf(line, "NSpid: %d %d", &outer, &inner);
  }
  std::fclose(status);
  return numbers == 2;
}
template <int number>
void kill_everyone() {
  if (confined()) kill(-1, number);  // or else it would be everyone on the machine
}

[[noreturn]] void wait_for_ever() {
  for (;;) pause();
}
[[noreturn]] void work_for_ever() {
  while (nowhere == 0) {
  }
  std::abort();
}
void on_signal(int) {}

// NOLINTNEXTLINE(performance-no-int-to-ptr)
void crash() { *reinterpret_cast<volatile int*>(nowhere) = 1; }
template <int number>
void raise_it() {
  raise(number);
}
void divide() {
  volatile int dividend = 7, divisor = 0;
  nowhere = static_cast<std::uintptr_t>(dividend / divisor);
}
void leave() { std::exit(0); }
void leave_slowly() {
  std::atexit(wait_for_ever);
  std::exit(0);
}
void leave_to_child() {
  if (fork() != 0) _exit(0);
}
void throw_number() { throw 7; }
void doze() {
  for (;;) usleep(1000);
}
void read_input() {
  char byte;
  if (read(0, &byte, 1) != 0) wait_for_ever();
}
void read_own_pipe() {
  int ends[2];
  char byte;
  if (pipe(ends) != 0 || read(ends[0], &byte, 1) != 1) std::abort();
}
void take_lock_twice() {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  pthread_mutex_lock(&mutex);
}
void fork_and_both_wait() {
  fork();
  wait_for_ever();
}
void fork_and_leave_one_waiting() {
  if (fork() == 0) wait_for_ever();
}
void vfork_and_wait() {
  if (vfork() == 0) wait_for_ever();
}
void daemon_that_waits() {
  if (fork() == 0) {
    setsid();
    if (fork() == 0) wait_for_ever();
    _exit(0);
  }
}
/// Forks five generations of two children each, all of which stay.
void multiply() {
  for (int generation = 0; generation < 5; ++generation) fork();
  wait_for_ever();
}
void daemon_that_kills_all() {
  if (fork() == 0) {
    setsid();
    if (fork() == 0) {
      usleep(2000);
      kill_everyone<SIGKILL>();
    }
    _exit(0);
  }
}
void* thread_that_works(void*) { work_for_ever(); }
void leave_a_thread_working() {
  pthread_t thread;
  pthread_create(&thread, nullptr, thread_that_works, nullptr);
}
void scribble(int fd, bool good_size) {
  char garbage[300];
  std::memset(garbage, 0x5a, sizeof garbage);
  // Once of the size of a Reply, once not.
  for (const std::size_t size : {std::size_t{1}, std::size_t{24}, sizeof garbage}) {
    [[maybe_unused]] const ssize_t written = write(fd, garbage, good_size ? size : 1);
  }
  send(fd, garbage, 0, MSG_NOSIGNAL);
}
void write_everywhere() {
  for (int fd = 0; fd < 1024; ++fd) scribble(fd, true);
}
void write_everywhere_for_ever() {
  for (;;) write_everywhere();
}
void close_everything() { close_range(0, ~0u, 0); }
void shut_everything() {
  for (int fd = 0; fd < 1024; ++fd) shutdown(fd, SHUT_RDWR);
}
void read_everything() {
  char bytes[4096];
  for (int fd = 3; fd < 1024; ++fd)
    [[maybe_unused]] const ssize_t got = read(fd, bytes, sizeof bytes);
}
void replace_everything() {
  const int nothing = open("/dev/null", O_RDWR);
  for (int fd = 0; fd < 64; ++fd) dup2(nothing, fd);
}
template <int number>
void kill_group() {
  kill(0, number);
}
template <int number>
void kill_parent() {
  kill(getppid(), number);
}
template <int number>
void kill_parents_group() {
  killpg(getpgid(getppid()), number);
}
void trace_me() {
  ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  raise(SIGUSR1);
}
void block_signals_and_work() {
  sigset_t all;
  sigfillset(&all);
  sigprocmask(SIG_BLOCK, &all, nullptr);
  work_for_ever();
}
void handle_signals_and_crash() {
  for (int number = 1; number < 32; ++number) {
    if (number != SIGSEGV) signal(number, on_signal);
  }
  crash();
}
void handle_crashes_and_crash() {  // the faulting instruction is done again and again
  signal(SIGSEGV, on_signal);
  crash();
}
void set_timer() {
  const itimerval soon{{0, 0}, {0, 300}};
  setitimer(ITIMER_REAL, &soon, nullptr);
}
void lower_limits() {
  for (const int resource : {RLIMIT_NOFILE, RLIMIT_FSIZE, RLIMIT_NPROC}) {
    const rlimit none{0, 0};
    setrlimit(static_cast<__rlimit_resource>(resource), &none);
  }
}
void raise_limits() {
  for (const int resource : {RLIMIT_AS, RLIMIT_FSIZE, RLIMIT_CORE}) {
    const rlimit all{RLIM_INFINITY, RLIM_INFINITY};
    setrlimit(static_cast<__rlimit_resource>(resource), &all);
  }
}
void allocate() { nowhere = reinterpret_cast<std::uintptr_t>(new char[std::size_t{1} << 40]); }
int recurse(int depth) {
  volatile char page[4096];
  page[0] = static_cast<char>(depth);
  return nowhere == 0 ? recurse(depth + 1) + page[0] : 0;
}
void change_surroundings() {
  if (chdir("/proc/self/task") != 0) std::abort();
  umask(0777);
  setlocale(LC_ALL, "C.UTF-8");
  setenv("LC_ALL", "tlh", 1);
  clearenv();
}
void remove_folder() {
  char name[] = "/tmp/touchstone-hostile-XXXXXX";
  if (!mkdtemp(name) || chdir(name) != 0 || rmdir(name) != 0) std::abort();
}
/// Calls act(first byte, size) for all memory that this process shares with others.
template <class Act>
void each_shared(const Act& act) {
  std::FILE* const maps = std::fopen("/proc/self/maps", "r");
  char line[512];
  while (maps && std::fgets(line, sizeof line, maps)) {
    void *from = nullptr, *to = nullptr;
    char rights[5] = "";
    if (std::sscanf(line, "%p-%p %4s", &from, &to, rights) == 3 && rights[3] == 's') {
      act(from, static_cast<std::size_t>(static_cast<char*>(to) - static_cast<char*>(from)));
    }
  }
  if (maps) std::fclose(maps);
}
void overwrite_shared(int byte) {
  each_shared([byte](void* from, std::size_t size) {
    mprotect(from, size, PROT_READ | PROT_WRITE);
    if (mprotect(from, size, PROT_WRITE) == 0) {
      mprotect(from, size, PROT_READ | PROT_WRITE);
      std::memset(from, byte, size);
    }
  });
}
void overwrite_and_crash() {
  overwrite_shared(0xff);
  crash();
}
void overwrite_and_wait() {
  overwrite_shared(0xff);
  wait_for_ever();
}
void unmap_shared() { each_shared(munmap); }
void print_much() {
  const std::vector<char> text(1 << 20, 'x');
  for (int i = 0; i < 20; ++i) {
    for (const int fd : {1, 2}) {
      [[maybe_unused]] const ssize_t written = write(fd, text.data(), text.size());
    }
  }
}
std::jmp_buf never_set;

enum class When { query, prepare, release, answer };
using End = HostileDeed::End;
using enum HostileDeed::End;
struct Deed : HostileDeed {
  When when;
  void (*plain)();
  void (*to_answer)(ts_answer&);
};
constexpr Deed in_query(const char* name, End ends, void (*deed)(), const char* reason = "") {
  return {{name, ends, reason}, When::query, deed, nullptr};
}
constexpr Deed in_prepare(const char* name, End ends, void (*deed)(), const char* reason = "") {
  return {{name, ends, reason}, When::prepare, deed, nullptr};
}
constexpr Deed in_release(const char* name, End ends, void (*deed)(), const char* reason = "") {
  return {{name, ends, reason}, When::release, deed, nullptr};
}
constexpr Deed in_answer(const char* name, End ends, void (*deed)(ts_answer&),
                         const char* reason = "") {
  return {{name, ends, reason}, When::answer, nullptr, deed};
}

constexpr Deed deeds[] = {
    in_query("nothing", answered, [] {}),
    in_query("segmentation fault", crashed, crash, "Segmentation fault"),
    in_query("division", crashed, divide, "Floating point exception"),
    in_query("abort", crashed, std::abort, "Aborted"),
    in_query("SIGTERM", crashed, raise_it<SIGTERM>, "Terminated"),
    in_query("SIGINT", crashed, raise_it<SIGINT>, "Interrupt"),
    in_query("SIGKILL", crashed, raise_it<SIGKILL>, "Killed"),
    in_query("SIGSTOP", timed_out, raise_it<SIGSTOP>, "waited"),
    in_query("SIGALRM", crashed, raise_it<SIGALRM>, "Alarm clock"),
    in_query("SIGBUS", crashed, raise_it<SIGBUS>, "Bus error"),
    in_query("exit", crashed, leave, "exit code 0"),
    in_query(
        "_exit", crashed, [] { _exit(0); }, "exit code 0"),
    in_query(
        "quick_exit", crashed, [] { std::quick_exit(0); }, "exit code 0"),
    in_query("exit with the host's own code", crashed, [] { _exit(97); }),
    in_query("exit with a handler that hangs", timed_out, leave_slowly, "waited"),
    in_query("leave the session to a child", answered_or_crashed, leave_to_child),
    in_query("throw", crashed, throw_number, "no exception"),
    in_query("endless loop", timed_out, work_for_ever, "no answer within"),
    in_query(
        "sleep", timed_out, [] { sleep(1000); }, "waited"),
    in_query("pause", timed_out, wait_for_ever, "waited"),
    in_query("doze", timed_out, doze, "waited"),
    in_query("read standard input", answered, read_input),
    in_query("read a pipe of its own", timed_out, read_own_pipe, "waited"),
    in_query("deadlock", timed_out, take_lock_twice, "waited"),
    in_query("fork, both pause", timed_out, fork_and_both_wait, "waited"),
    in_query("fork, both return", answered, [] { fork(); }),
    in_query("fork, the child pauses", answered, fork_and_leave_one_waiting),
    in_query("vfork, the child pauses", timed_out, vfork_and_wait, "waited"),
    in_query("daemon", answered, daemon_that_waits),
    in_query("thirty-two processes", timed_out, multiply, "waited"),
    in_query("daemon that kills all later", answered, daemon_that_kills_all),
    in_query("thread left working", answered, leave_a_thread_working),
    in_query("write to all descriptors", answered, write_everywhere),
    in_query("write to all descriptors for ever", timed_out, write_everywhere_for_ever),
    in_query("close all descriptors", answered_or_crashed, close_everything),
    in_query("shut all sockets", answered_or_crashed, shut_everything),
    in_query("read all descriptors", timed_out, read_everything, "waited"),
    in_query("replace all descriptors", answered_or_crashed, replace_everything),
    in_query("interrupt the group", crashed, kill_group<SIGINT>, "Interrupt"),
    in_query("kill the group", crashed, kill_group<SIGKILL>, "Killed"),
    in_query("stop the group", timed_out, kill_group<SIGSTOP>, "waited"),
    in_query("kill everyone", answered_or_crashed, kill_everyone<SIGKILL>),
    in_query("stop everyone", whatever, kill_everyone<SIGSTOP>),
    in_query("kill the parent", answered_or_crashed, kill_parent<SIGKILL>),
    in_query("stop the parent", answered_or_crashed, kill_parent<SIGSTOP>),
    in_query("interrupt the parent", answered_or_crashed, kill_parent<SIGINT>),
    in_query("kill the parent's group", answered_or_crashed, kill_parents_group<SIGKILL>),
    in_query("be traced", crashed, trace_me),
    in_query("trace the parent", answered_or_crashed,
             [] { ptrace(PTRACE_ATTACH, getppid(), nullptr, nullptr); }),
    in_query("block all signals and loop", timed_out, block_signals_and_work, "no answer within"),
    in_query("handle all signals and crash", crashed, handle_signals_and_crash,
             "Segmentation fault"),
    in_query("handle crashes and crash", timed_out, handle_crashes_and_crash, "no answer within"),
    in_query("alarm", answered, [] { alarm(1); }),
    in_query("timer", answered_or_crashed, set_timer),
    in_query("lower limits", answered, lower_limits),
    in_query("raise limits", answered, raise_limits),
    in_query("allocate a tebibyte", crashed, allocate, "std::bad_alloc"),
    in_query(
        "overflow the stack", crashed,
        [] { nowhere = static_cast<std::uintptr_t>(recurse(0)) * nowhere; }, "Segmentation fault"),
    in_query("change folder, mask, locale, environment", answered, change_surroundings),
    in_query("remove its folder", answered, remove_folder),
    in_query("round upward", answered, [] { std::fesetround(FE_UPWARD); }),
    in_query("flush subnormals", answered, [] { _mm_setcsr(_mm_getcsr() | 0x8040); }),
    in_query("trap on inexact", answered_or_crashed, [] { feenableexcept(FE_ALL_EXCEPT); }),
    in_query("overwrite shared memory with ones", answered, [] { overwrite_shared(0xff); }),
    in_query("overwrite shared memory with zeros", answered, [] { overwrite_shared(0); }),
    in_query("overwrite shared memory and crash", crashed, overwrite_and_crash,
             "Segmentation fault"),
    in_query("overwrite shared memory and pause", timed_out, overwrite_and_wait, "waited"),
    in_query("unmap shared memory", crashed, unmap_shared, "Segmentation fault"),
    in_query("print 40 MiB", answered, print_much),
    in_query("jump nowhere", crashed, [] { std::longjmp(never_set, 1); }),
    in_query("end the thread", crashed, [] { pthread_exit(nullptr); }),
    in_prepare("crash in prepare", crashed, crash, "Segmentation fault"),
    in_prepare("exit in prepare", crashed, leave, "exit code 0"),
    in_prepare("throw in prepare", crashed, throw_number, "no exception"),
    in_prepare("pause in prepare", timed_out, wait_for_ever, "waited"),
    in_release("crash in release", crashed, crash, "Segmentation fault"),
    in_release("exit in release", crashed, leave, "exit code 0"),
    in_release("pause in release", timed_out, wait_for_ever, "waited"),
    in_answer("a billion points", failed, [](ts_answer& a) { a.point_count = 1000000000; }),
    in_answer("minus one point", failed, [](ts_answer& a) { a.point_count = -1; }),
    in_answer("not a number", answered,
              [](ts_answer& a) { a.signed_distance = std::numeric_limits<double>::quiet_NaN(); }),
    in_answer("unknown status", failed,
              [](ts_answer& a) { std::memset(&a.status, 0x77, sizeof a.status); }),
    in_answer("claim a timeout", failed, [](ts_answer& a) { a.status = TS_TIMED_OUT; }),
    in_answer(
        "write beyond the answer", crashed,
        [](ts_answer& a) { std::memset(&a.points[TOUCHSTONE_MAX_POINTS], 1, 4096); },
        "Segmentation fault"),
    in_answer("write before the answer", answered,
              [](ts_answer& a) { std::memset(reinterpret_cast<char*>(&a) - 3000, 1, 3000); }),
};
constexpr int count = sizeof deeds / sizeof *deeds;

}  // namespace

struct ts_prepared {
  const Deed* deed;
  bool culprit;
};

namespace {

constexpr double culprits_radius = 7;
const ts_parameter which = {"number of the deed", 1, count, 1, 1, 0};

int supports(void*, ts_shape_kind) { return 1; }
bool is_culprit(const ts_shape* a) {
  return a->size[0] == culprits_radius || std::getenv("TOUCHSTONE_HOSTILE_EVERYWHERE");
}

ts_prepared* prepare(void*, const ts_shape* a, const ts_shape*, double, double parameter) {
  const Deed* const deed = &deeds[static_cast<int>(parameter) - 1];
  if (is_culprit(a) && deed->when == When::prepare) deed->plain();
  return new ts_prepared{deed, is_culprit(a)};
}
void query(ts_prepared* prepared, const ts_pose* a, const ts_pose*, const double*,
           ts_answer* answer) {
  const Deed& deed = *prepared->deed;
  if (prepared->culprit && deed.when == When::query) deed.plain();
  behave(*answer, a->position[0]);
  if (prepared->culprit && deed.when == When::answer) deed.to_answer(*answer);
}
void release(ts_prepared* prepared) {
  if (prepared->culprit && prepared->deed->when == When::release) prepared->deed->plain();
  delete prepared;
}

// While it is loaded

ts_candidate candidate = {"hostile", "1",   "does one deed", nullptr, &which, supports,
                          prepare,   query, release,         nullptr, nullptr};
ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 1, &candidate, nullptr, 0, nullptr};

/// Fills the available memory with letters, to the last byte.
const char* endless_text() {
  const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  void* const memory =
      mmap(nullptr, 3 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  std::memset(memory, 'x', 2 * page);
  mprotect(static_cast<char*>(memory) + 2 * page, page, PROT_NONE);
  return static_cast<const char*>(memory);
}
int supports_nothing_and_hangs(void*, ts_shape_kind) { wait_for_ever(); }
void set_timer_of_the_host() {
  const itimerval later{{0, 0}, {0, 200000}};
  setitimer(ITIMER_REAL, &later, nullptr);
}

constexpr struct {
  const char* name;
  void (*deed)();
} loading_deeds[] = {
    {"crash", crash},
    {"abort", std::abort},
    {"exit", leave},
    {"throw", throw_number},
    {"pause", wait_for_ever},
    {"loop", work_for_ever},
    {"fork, both pause", fork_and_both_wait},
    {"daemon", daemon_that_waits},
    {"stop", raise_it<SIGSTOP>},
    {"write to all descriptors", write_everywhere},
    {"close all descriptors", close_everything},
    {"kill the group", kill_group<SIGKILL>},
    {"kill the parent", kill_parent<SIGKILL>},
    {"handle all signals",
     [] {
       for (int number = 1; number < 32; ++number) signal(number, SIG_IGN);
     }},
    {"timer", set_timer_of_the_host},
    {"thread", leave_a_thread_working},
    {"print 40 MiB", print_much},
    {"wrong version", [] { plugin.interface_version = 77; }},
    {"no candidates", [] { plugin.candidates = nullptr; }},
    {"a billion candidates", [] { plugin.count = 1000000000; }},
    {"minus one candidate", [] { plugin.count = -1; }},
    {"no name", [] { candidate.name = nullptr; }},
    {"endless name", [] { candidate.name = endless_text(); }},
    {"endless settings", [] { candidate.settings = endless_text(); }},
    {"no query", [] { candidate.query = nullptr; }},
    {"no release", [] { candidate.release = nullptr; }},
    {"supports hangs", [] { candidate.supports = supports_nothing_and_hangs; }},
};

void do_as_asked() {
  const char* const asked = std::getenv("TOUCHSTONE_HOSTILE_LOAD");
  for (const auto& [name, deed] : loading_deeds) {
    if (asked && std::strcmp(asked, name) == 0) deed();
  }
}

}  // namespace

const ts_plugin* touchstone_plugin() {
  do_as_asked();
  return &plugin;
}

/// The deeds in order, for the test, which does not perform them; null after the last.
extern "C" TOUCHSTONE_EXPORT const HostileDeed* hostile_deed(int i) {
  return i < count ? &deeds[i] : nullptr;
}
