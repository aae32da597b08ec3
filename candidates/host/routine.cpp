#include "candidates/host/routine.hpp"

#include <algorithm>

namespace touchstone {
Routine::Routine(const ts_candidate& candidate, Roundings roundings, double parameter)
    : candidate_(candidate), roundings_(roundings), parameter_(parameter) {
  std::fegetenv(&environment_);
}

bool Routine::PreparedPair::is_for(const Question& q) const {
  return same(a, q.a) && same(b.get(), q.b) && threshold == q.threshold;
}

ts_prepared* Routine::prepare(const Question& q) const {
  if (!candidate_.supports(candidate_.context, q.b.kind)) return nullptr;
  if (!roundings_ && (q.a.rounding != 0 || q.b.rounding != 0)) return nullptr;
  return candidate_.prepare(candidate_.context, &q.a, &q.b, q.threshold, parameter_);
}

ts_prepared* Routine::ready(const Question& q) {
  const auto found = std::find_if(ready_.begin(), ready_.end(),
                                  [&](const PreparedPair& r) { return r.is_for(q); });
  if (found != ready_.end()) {
    std::rotate(found, found + 1, ready_.end());
    return ready_.back().prepared;
  }
  if (ready_.size() == max_ready) {
    if (ready_.front().prepared) candidate_.release(ready_.front().prepared);
    ready_.erase(ready_.begin());
  }
  ready_.push_back({q.a, OwnedShape(q.b), q.threshold, prepare(q)});
  return ready_.back().prepared;
}

Modelled Routine::ask(const Question& q, ts_answer& answer) {
  Modelled modelled;
  answer = {};
  answer.status = TS_UNSUPPORTED;
  std::fesetenv(&environment_);  // a rounding mode left by a query would affect the next one
  ts_prepared* const prepared = ready(q);
  if (!prepared) return modelled;
  const double* const hint = q.has_previous_normal ? q.previous_normal : nullptr;
  candidate_.query(prepared, &q.pose_a, &q.pose_b, hint, &answer);
  if (candidate_.model_distance) {
    modelled.distance = candidate_.model_distance(prepared, &q.pose_a, &q.pose_b);
  }
  if (!roundings_) return modelled;
  double of_a = 0, of_b = 0;
  roundings_(prepared, &of_a, &of_b);
  if (of_a != q.a.rounding || of_b != q.b.rounding) {
    modelled.roundings[0] = of_a;
    modelled.roundings[1] = of_b;
  }
  return modelled;
}

void Routine::release_all_but_of(const Questions& questions, std::uint32_t first,
                                 std::uint32_t end) {
  std::erase_if(ready_, [&](const PreparedPair& r) {
    for (std::uint32_t i = first; i < end; ++i) {
      if (r.is_for(questions.get(i))) return false;
    }
    if (r.prepared) candidate_.release(r.prepared);
    return true;
  });
}

void Routine::release_all() {
  for (const PreparedPair& r : ready_) {
    if (r.prepared) candidate_.release(r.prepared);
  }
  ready_.clear();
}

}  // namespace touchstone
