// The questions of laws to a candidate, one law in a session of its own or many in one.
#include <algorithm>

#include "properties/laws/law.hpp"

namespace touchstone {
namespace {

/// The law's own bar: it may ask within another threshold.
Bar bar_of(const Law& law, const Configuration& c, const Bar& given) {
  Bar bar = given;
  if (law.threshold) bar.threshold = law.threshold(c, given);
  return bar;
}

/// The law "answers" judges each answer alone.
bool is_answers(const Law& law) { return law.judge == all_laws().front().judge; }

/// Can other laws judge it?
bool is_judged(const Configuration& c, const Answer& answer, const Bar& bar) {
  return !all_laws().front().judge(c, {&answer, 1}, bar);
}

/// Questions that are asked together in a session.
class QuestionList {
 public:
  void add(const HintedQuestion& question, double threshold) {
    configurations_.push_back(question.configuration);
    hints_.push_back(question.previous_normal);
    thresholds_.push_back(threshold);
  }
  std::vector<Answer> ask(CandidateProcess& candidate) const {
    std::vector<const Vec3*> hints;
    for (const auto& hint : hints_) hints.push_back(hint ? &*hint : nullptr);
    return candidate.answer(configurations_, hints, thresholds_);
  }

 private:
  std::vector<Configuration> configurations_;
  std::vector<std::optional<Vec3>> hints_;
  std::vector<double> thresholds_;
};

/// A law and a configuration, and the answers up to now.
struct Inquiry {
  const Law& law;
  const Configuration& configuration;
  Bar bar;
  std::vector<Answer> answers = {};
  std::size_t asked = 0;  ///< questions whose answers are still to come

  /// The law's questions besides the configuration itself.
  void put_questions(QuestionList& list) {
    for (Configuration& question : law.questions(configuration, bar)) {
      put({std::move(question), {}}, list);
    }
  }
  /// Those that depend on the first answer.
  void put_last_questions(QuestionList& list) {
    if (!law.hinted_questions || !is_judged(configuration, answers[0], bar)) return;
    for (const HintedQuestion& question : law.hinted_questions(configuration, answers[0], bar)) {
      put(question, list);
    }
  }
  void put(const HintedQuestion& question, QuestionList& list) {
    list.add(question, bar.threshold);
    ++asked;
  }
  /// Takes the answers to what it has put, from `next` on.
  void take(std::vector<Answer>::iterator& next) {
    for (; asked > 0; --asked) answers.push_back(std::move(*next++));
  }

  bool has_failure() const {
    return std::ranges::any_of(answers, [](const Answer& a) {
      return a.status == TS_CRASHED || a.status == TS_TIMED_OUT;
    });
  }
  std::optional<Violation> verdict() const {
    const auto is_bad = [&](const Answer& a) { return !is_judged(configuration, a, bar); };
    if (!is_answers(law) && std::ranges::any_of(answers, is_bad)) return std::nullopt;
    return law.judge(configuration, answers, bar);
  }
};

/// Asks what the inquiries put by `put`, all together, and hands them the answers.
template <class Put>
void ask(std::span<Inquiry> inquiries, CandidateProcess& candidate, const Put& put) {
  QuestionList list;
  for (Inquiry& inquiry : inquiries) put(inquiry, list);
  std::vector<Answer> answers = list.ask(candidate);
  auto next = answers.begin();
  for (Inquiry& inquiry : inquiries) inquiry.take(next);
}

void ask_last_questions(std::span<Inquiry> inquiries, CandidateProcess& candidate) {
  ask(inquiries, candidate, [](Inquiry& i, QuestionList& list) { i.put_last_questions(list); });
}

}  // namespace

std::optional<Violation> broken(const Law& law, const Configuration& c, CandidateProcess& candidate,
                                const Bar& given) {
  if (!law.applies(c)) return std::nullopt;
  Inquiry inquiry{law, c, bar_of(law, c, given)};
  candidate.ask_within(inquiry.bar.threshold);
  std::vector<Configuration> asked{c};
  for (Configuration& question : law.questions(c, inquiry.bar)) {
    asked.push_back(std::move(question));
  }
  inquiry.answers = candidate.answers(asked);
  if (inquiry.answers[0].status == TS_UNSUPPORTED) return std::nullopt;
  ask_last_questions({&inquiry, 1}, candidate);
  return inquiry.verdict();
}

std::vector<Violations> broken_in_session(std::span<const Law* const> laws,
                                          std::span<const Configuration> configurations,
                                          CandidateProcess& candidate, const Bar& given) {
  QuestionList list;
  for (const Configuration& c : configurations) list.add({c, {}}, given.threshold);
  const std::vector<Answer> first = list.ask(candidate);
  // Where there is no answer to judge, the other questions could only time out or crash as well.
  std::vector<bool> is_answered;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    is_answered.push_back(is_judged(configurations[i], first[i], given));
  }
  std::vector<Violations> result(configurations.size());
  std::vector<Inquiry> inquiries;
  std::vector<std::optional<Violation>*> places;
  for (std::size_t i = 0; i < configurations.size(); ++i) {
    if (first[i].status == TS_UNSUPPORTED) continue;
    result[i].resize(laws.size());
    for (std::size_t k = 0; k < laws.size(); ++k) {
      const Configuration& c = configurations[i];
      if (!laws[k]->applies(c)) continue;
      Inquiry& inquiry = inquiries.emplace_back(Inquiry{*laws[k], c, bar_of(*laws[k], c, given)});
      // Within another threshold the configuration itself is asked again.
      if (!laws[k]->threshold || !is_answered[i]) inquiry.answers.push_back(first[i]);
      places.push_back(&result[i][k]);
    }
  }
  ask(inquiries, candidate, [&](Inquiry& inquiry, QuestionList& questions) {
    const auto i = static_cast<std::size_t>(&inquiry.configuration - configurations.data());
    if (!is_answered[i]) return;
    if (inquiry.answers.empty()) inquiry.put({inquiry.configuration, {}}, questions);
    inquiry.put_questions(questions);
  });
  ask_last_questions(inquiries, candidate);
  // A command is not asked on after failures in a row, which may be of another configuration.
  const bool is_command = candidate.candidate().command() != nullptr;
  for (std::size_t i = 0; i < inquiries.size(); ++i) {
    const Inquiry& inquiry = inquiries[i];
    const bool is_lost = is_command && inquiry.has_failure();
    *places[i] =
        is_lost ? broken(inquiry.law, inquiry.configuration, candidate, given) : inquiry.verdict();
  }
  return result;
}

Violations broken_in_session(std::span<const Law* const> laws, const Configuration& configuration,
                             CandidateProcess& candidate, const Bar& bar) {
  return broken_in_session(laws, std::span(&configuration, 1), candidate, bar).front();
}

}  // namespace touchstone
