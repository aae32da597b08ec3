#pragma once

#include <functional>
#include <string>

namespace touchstone {

/// What a task that ran in a process of its own came to.
struct Contained {
  enum class End { returned, crashed, timed_out };
  End end;
  std::string text;  ///< the result or, if there is none, the reason: "Segmentation fault"
};

/// Runs a task of this program in a forked process, which may crash, hang or change global state.
/// It is ended after `seconds` of processor time, or four times as long by the clock. Exceptions
/// count as a crash, with their text. What the task prints is lost.
Contained run_contained(const std::function<std::string()>& task, double seconds);

}  // namespace touchstone
