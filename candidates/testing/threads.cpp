// An engine with a thread that does its queries, for tests. The thread is started when the plug-in
// is loaded, which a fork does not survive, unless AFTER_FORK starts it in the session; UNFORKED
// asks not to be forked. "threads:13" crashes on every query.
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "candidates/candidate.h"

struct ts_prepared {
  const double* scale;  ///< the context
  bool crashes;
};

namespace {

class Worker {
 public:
  Worker() : thread_([this] { work(); }) { thread_.detach(); }

  double minus(double x) {
    std::unique_lock lock(mutex_);
    asked_ = x;
    is_asked_ = true;
    changed_.notify_all();
    changed_.wait(lock, [&] { return !is_asked_; });
    return answer_;
  }

 private:
  [[noreturn]] void work() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [&] { return is_asked_; });
      answer_ = -asked_;
      is_asked_ = false;
      changed_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  double asked_ = 0, answer_ = 0;
  bool is_asked_ = false;
  std::thread thread_;
};

Worker* worker = nullptr;
void start_worker() { worker = new Worker; }

double scale = 3;

int supports(void* context, ts_shape_kind) { return context == &scale; }

ts_prepared* prepare(void* context, const ts_shape*, const ts_shape*, double, double parameter) {
  return new ts_prepared{static_cast<double*>(context), parameter == 13};
}

void query(ts_prepared* prepared, const ts_pose* a, const ts_pose*, const double*,
           ts_answer* answer) {
  if (prepared->crashes) std::abort();
  answer->status = TS_CONTACT;
  answer->normal[2] = 1;
  answer->signed_distance = worker->minus(*prepared->scale * a->position[0]);
}

void release(ts_prepared* prepared) { delete prepared; }

constexpr ts_parameter number = {"number", 1, 99, 1, 1, 1};
const ts_candidate candidate = {TOUCHSTONE_THREADS_NAME,
                                "1",
                                "asks its thread",
                                nullptr,
                                &number,
                                supports,
                                prepare,
                                query,
                                release,
                                nullptr,
                                &scale};
#ifdef AFTER_FORK
const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 1, &candidate, start_worker, 0, nullptr};
#else
const ts_plugin plugin = {TOUCHSTONE_INTERFACE_VERSION, 1, &candidate, nullptr, 1, nullptr};
#endif

}  // namespace

const ts_plugin* touchstone_plugin() {
#ifndef AFTER_FORK
  if (!worker) start_worker();
#endif
  return &plugin;
}
