#pragma once

#include <vector>

#include "reports/report.hpp"

namespace touchstone {

/// One-sided p-value of Fisher's exact test: if failing had nothing to do with it, the probability
/// that at least as many of all failures fall on `with`.
double chance(const FailureRate& without, const FailureRate& with);

/// Finds what raises each candidate's failure rate most, of each pair and group: one arrangement
/// and one modifier, where there is one that does beyond chance.
///
/// Like is compared with like. A class with a modifier is compared with the class that is equal but
/// for it; where that was not run, with those of its arrangement without the modifier whose other
/// modifiers differ least, lest the modifier be blamed for what another one does. A class of an
/// arrangement is compared with those of other arrangements that have the same modifiers, where a
/// random orientation counts as turned; where there are none, it is left out. `without` is the mean
/// rate of what the classes with it were compared with, weighted by their counts.
std::vector<Factor> factors(const Report& report);

/// Compares each arrangement's own class with the same one turned, and with that of its tilts on
/// which the candidate fails most, for each candidate that has a routine for the pair.
std::vector<Contrast> contrasts(const Report& report);

/// Lists the contrasts to be pointed out, those of a candidate together: everyday poses turned,
/// then other turned ones, then tilted ones. Among these, the largest of each pair of shapes comes
/// first, then the second of each.
std::vector<const Contrast*> failing_contrasts(const Report& report);

/// How often a scene may meet the modified class: 0 of everyday poses turned, 1 of others turned, 2
/// of tilted ones.
int rarity(const Contrast& contrast);

/// "cylinder-cylinder/perpendicular-t agrees in 87%, turned in 30%".
std::string contrast_text(const Contrast& contrast);
/// "./touchstone replay IDENTITY", of the worst failure with the modifier.
std::string contrast_command(const Contrast& contrast);

}  // namespace touchstone
