#pragma once

#include "properties/laws/law.hpp"

namespace touchstone {

// The law "hint": two frames of a simulation, with the first one's normal as the second one's hint.
// In the second frame A is pressed into B along that normal by a hundred-thousandth of the smaller
// size, as gravity does: a unique normal stays what it was, and where several tie, every other one
// becomes the better one by up to twice the step. A routine without memory then chooses anew, and
// its normal flickers from frame to frame; what the hint is for is to stay.

/// Contacts are asked for within half of the bar, so that what a hint decides is no failure of its
/// own.
double hint_threshold(const Configuration& configuration, const Bar& bar);

/// The second frame three times: without a hint, with the first answer's normal, and with its
/// opposite, as a body leaves behind that was caught on the other side.
std::vector<Frame> hinted_frames(const Configuration& configuration, const Answer& first,
                                 const Bar& bar);

/// "jump" where the normal turns away from the hint though the hint is still as good. Any other
/// failure where the answer agrees with the truth without a hint and not with one.
std::optional<Violation> judge_hint(const Configuration& configuration,
                                    std::span<const Answer> answers, const Bar& bar);

}  // namespace touchstone
