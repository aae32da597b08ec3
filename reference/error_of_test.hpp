#pragma once

#include <string>

#include "reference/invalid_input.hpp"

namespace touchstone {

/// What a call is refused with; where it is not, "accepted" in all places.
template <class Call>
InvalidInput error_of(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& e) {
    return e;
  }
  return {"accepted", "accepted", "accepted"};
}

/// The same as a text, or "accepted".
template <class Call>
std::string error_text_of(const Call& call) {
  const InvalidInput e = error_of(call);
  return e.field() == "accepted" ? e.field() : e.what();
}

}  // namespace touchstone
