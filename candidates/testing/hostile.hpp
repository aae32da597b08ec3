#pragma once

#include "candidates/candidate.h"

/// A deed of the plug-in hostile.cpp, and what becomes of the configuration on which it happens.
struct HostileDeed {
  /// Bits of statuses. It may have answered before its deed ends the session.
  enum End {
    answered = 1 << TS_CONTACT,
    crashed = 1 << TS_CRASHED,
    answered_or_crashed = answered + crashed,
    timed_out = 1 << TS_TIMED_OUT,
    whatever = answered_or_crashed + timed_out,
    failed = 1 << TS_FAILED
  };
  const char* name;
  End ends;
  const char* reason;  ///< part of what is said of it
};
