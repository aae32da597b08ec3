#pragma once

#include <cstdarg>
#include <ode/ode.h>

static_assert(sizeof(dReal) == sizeof(double), "built against single-precision ODE");

namespace touchstone {

/// Starts ODE once in this process. Its messages are ignored: its own handlers print, and end the
/// process on internal errors.
inline void initialise_ode() {
  static const bool done = [] {
    dInitODE2(0);
    dSetMessageHandler([](int, const char*, va_list) {});
    dAllocateODEDataForThread(dAllocateMaskAll);
    return true;
  }();
  (void)done;
}

}  // namespace touchstone
