#include <algorithm>
#include <chrono>
#include <signal.h>
#include <sys/time.h>

#include "candidates/host/interruption.hpp"
#include "candidates/host/respondent.hpp"
#include "candidates/readable.hpp"
#include "python/bindings.hpp"

namespace touchstone::python {
namespace {

using Clock = std::chrono::steady_clock;

/// Raised in a function that takes too long: no Exception, which it may catch.
PyObject* too_long() {
  static PyObject* const type =
      PyErr_NewException("touchstone.TooLong", PyExc_BaseException, nullptr);
  return type;
}

/// Sets the alarm, which rings once an interrupt may have to be heard, and again and again, lest a
/// function catches everything; no seconds end it.
void set_alarm(double seconds) {
  constexpr double max_deaf = 0.1;
  const auto interval = [](double length) {
    const auto whole = static_cast<time_t>(length);
    return timeval{whole, static_cast<suseconds_t>((length - static_cast<double>(whole)) * 1e6)};
  };
  const itimerval timer{interval(std::min(seconds / 4, max_deaf)),
                        interval(std::min(seconds, max_deaf))};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

/// A worker ends without Python's knowledge: what the function printed would be lost.
void flush_output() { py::module_::import("sys").attr("stdout").attr("flush")(); }

/// "ValueError: what it says".
std::string text_of(const py::error_already_set& error) {
  auto type = error.type().attr("__name__").cast<std::string>();
  try {
    const auto text = py::str(error.value()).cast<std::string>();
    return readable(text.empty() ? type : type + ": " + text);
  } catch (const std::exception&) {  // its text raises, too
    return type;
  }
}

/// A Python function that answers a candidate's questions, function(a, pose_a, b, pose_b,
/// threshold), in the process that it is made in. What it raises fails its question alone. One that
/// takes too long is ended by an exception, which cannot end a call of compiled code; one that
/// crashes ends its process. Python's lock must be held throughout.
class FunctionRespondent : public Respondent {
 public:
  FunctionRespondent(py::function function, double seconds);
  ~FunctionRespondent() override;
  FunctionRespondent(const FunctionRespondent&) = delete;
  FunctionRespondent& operator=(const FunctionRespondent&) = delete;

  /// A function takes no hints.
  std::optional<NoAnswer> ask(std::span<const Asked> asked, bool release,
                              std::span<std::optional<Answer>> answers) override;
  void end_session() override {}
  bool prepare_timing(std::span<const Asked> asked) override;
  std::optional<QueryCost> cost_per_query() override;

 private:
  py::tuple arguments_of(const Asked& asked) const;
  Answer answer_to(const py::tuple& arguments) const;
  /// Calls action(), which an exception ends after so many seconds.
  template <class Action>
  void call_within(double seconds, const Action& action) const;

  py::function function_;
  double seconds_;
  mutable std::chrono::steady_clock::time_point end_;  ///< of the call under way
  py::object previous_handler_;                        ///< of the alarm; null: there is no limit
  std::vector<py::tuple> timed_;  ///< arguments of the questions that are timed
  std::size_t passes_ = 1;        ///< over them, in a round
};

FunctionRespondent::FunctionRespondent(py::function function, double seconds)
    : function_(std::move(function)), seconds_(seconds) {
  const auto ring = py::cpp_function([this](int, const py::object&) {
    if (Clock::now() < end_ && !interrupted()) return;
    PyErr_SetNone(too_long());
    throw py::error_already_set();
  });
  try {
    previous_handler_ = py::module_::import("signal").attr("signal")(SIGALRM, ring);
  } catch (const py::error_already_set& error) {
    if (!error.matches(PyExc_ValueError)) throw;  // not the main thread
  }
}

FunctionRespondent::~FunctionRespondent() {
  if (!previous_handler_ || previous_handler_.is_none()) return;
  py::module_::import("signal").attr("signal")(SIGALRM, previous_handler_);
}

template <class Action>
void FunctionRespondent::call_within(double seconds, const Action& action) const {
  if (!previous_handler_) return action();
  /// An alarm that has rung must be heard before this ends, or it would end other code.
  struct Alarm {
    explicit Alarm(double length) { set_alarm(length); }
    ~Alarm() {
      set_alarm(0);
      if (PyErr_CheckSignals() != 0) PyErr_Clear();
    }
  };
  constexpr double forever = 1e8;  // of Clock's nanoseconds, without overflow
  end_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                            std::chrono::duration<double>(std::min(seconds, forever)));
  const Alarm alarm(seconds);
  action();
}

py::tuple FunctionRespondent::arguments_of(const Asked& asked) const {
  const Configuration& c = *asked.configuration;
  // What every candidate is given: unit orientations, a plane's unit normal.
  const auto unit = [](const Pose& p) { return Pose(p.position(), p.unit_orientation()); };
  Shape b = c.b;
  if (const auto* const plane = std::get_if<Plane>(&c.b)) {
    b = Plane(plane->unit_normal(), plane->unit_displacement());
  }
  return py::make_tuple(c.a, unit(c.pose_a), shape_to_python(b), unit(c.pose_b), asked.threshold);
}

Answer FunctionRespondent::answer_to(const py::tuple& arguments) const {
  Answer answer{};
  if (interrupted()) {  // what is left to ask would keep the person waiting
    answer.status = TS_FAILED;
    answer.reason = "was interrupted";
    return answer;
  }
  try {
    call_within(seconds_, [&] { answer = answer_from_python(function_(*arguments)); });
  } catch (const py::error_already_set& error) {
    const bool was_ended = error.matches(too_long());
    answer.status = was_ended ? TS_TIMED_OUT : TS_FAILED;
    answer.reason =
        was_ended ? "no answer within " + py::str(py::float_(seconds_)).cast<std::string>() + " s"
                  : "raised " + text_of(error);
  }
  return answer;
}

std::optional<NoAnswer> FunctionRespondent::ask(std::span<const Asked> asked, bool /*release*/,
                                                std::span<std::optional<Answer>> answers) {
  std::optional<NoAnswer> timeout;
  for (std::size_t i = 0; i < asked.size() && !timeout; ++i) {
    const Answer answer = answer_to(arguments_of(asked[i]));
    if (answer.status == TS_TIMED_OUT) {
      timeout = NoAnswer{TS_TIMED_OUT, answer.reason, true, true};
    } else {
      answers[i] = answer;
    }
  }
  flush_output();
  return timeout;
}

bool FunctionRespondent::prepare_timing(std::span<const Asked> asked) {
  constexpr std::size_t min_timed = 10;
  constexpr auto max_once = std::chrono::microseconds(500),
                 min_round = std::chrono::microseconds(500);
  timed_.clear();
  Clock::duration once{};
  for (const Asked& question : asked) {
    if (timed_.size() >= min_timed && once > max_once) break;
    const py::tuple arguments = arguments_of(question);
    const auto start = Clock::now();
    if (answer_to(arguments).status == TS_TIMED_OUT) return false;
    once += Clock::now() - start;
    timed_.push_back(arguments);
  }
  passes_ = 1 + static_cast<std::size_t>(min_round / std::max(once, Clock::duration(1)));
  return true;
}

std::optional<QueryCost> FunctionRespondent::cost_per_query() {
  const double queries = static_cast<double>(passes_ * timed_.size());
  Clock::duration spent{};
  try {
    call_within(seconds_ * queries, [&] {
      const auto start = Clock::now();
      for (std::size_t pass = 0; pass < passes_ && !interrupted(); ++pass) {
        for (const py::tuple& arguments : timed_) {
          // What fails takes its time, too.
          PyObject* const result = PyObject_Call(function_.ptr(), arguments.ptr(), nullptr);
          if (!result && PyErr_ExceptionMatches(too_long())) throw py::error_already_set();
          if (!result) PyErr_Clear();
          Py_XDECREF(result);
        }
      }
      spent = Clock::now() - start;
    });
  } catch (const py::error_already_set&) {
    return std::nullopt;
  }
  return QueryCost{std::chrono::duration<double, std::nano>(spent).count() / queries, {}, {}};
}

}  // namespace

std::unique_ptr<Respondent> function_respondent(const py::function& function, double seconds) {
  return std::make_unique<FunctionRespondent>(function, seconds);
}

}  // namespace touchstone::python
