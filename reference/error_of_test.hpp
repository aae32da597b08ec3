#pragma once

#include <gmock/gmock.h>
#include <string>
#include <vector>

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

/// A text that is refused, the part of it that is named, and what the remedy says.
struct Refused {
  const char *text, *field, *remedy;
};
template <class Parse>
void expect_refusals(const std::vector<Refused>& texts, const Parse& parse) {
  for (const auto& [text, field, remedy] : texts) {
    const InvalidInput error = error_of([&, given = text] { parse(given); });
    EXPECT_EQ(error.field(), field) << text;
    EXPECT_THAT(error.remedy(), testing::HasSubstr(remedy)) << text;
  }
}

}  // namespace touchstone
