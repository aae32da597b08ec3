// Judges answers to configurations.
#include <pybind11/stl.h>

#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "python/parameters.hpp"
#include "reference/invalid_input.hpp"
#include "reports/campaign.hpp"

namespace touchstone::python {
namespace {

/// A score, with the reason for an answer that is none.
struct JudgedAnswer {
  Score score;
  std::string reason;
};

JudgedAnswer score_of(const NamedConfiguration& c, py::handle given, double tolerance,
                      double threshold) {
  check_threshold(threshold);
  if (!(tolerance > 0)) {
    throw InvalidInput("tolerance", py::repr(py::float_(tolerance)).cast<std::string>(),
                       "must be positive");
  }
  const Answer answer = answer_from_python(given);
  const oracle::Truth truth = oracle::truth(c.configuration, truth_width);
  return {score(c.configuration, truth, answer, {tolerance, threshold}), answer.reason};
}

py::list scores_of(const py::sequence& configurations, const py::sequence& answers,
                   double tolerance, double threshold) {
  if (configurations.size() != answers.size()) {
    throw InvalidInput(
        "answers", "a sequence of " + std::to_string(answers.size()),
        "must be as many as configurations, " + std::to_string(configurations.size()));
  }
  py::list result;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    const py::object configuration = configurations[i], answer = answers[i];
    const auto& named = element<NamedConfiguration>("configurations", i, configuration,
                                                    must_be<NamedConfiguration>);
    result.append(score_of(named, answer, tolerance, threshold));
  }
  return result;
}

}  // namespace

void bind_scores(py::module_& m) {
  py::class_<JudgedAnswer> type(m, "Score", R"(How right one answer is.

Errors are relative to the smaller body's smallest half extent, but for bodies of very uneven size.
What the answer does not define is None.
)");
  type.def_property_readonly(
      "outcome", [](const JudgedAnswer& s) { return outcome_name(s.score.outcome); },
      "\"agree\", or the symptom: \"missed\", \"phantom\", \"shallow\", \"wrong-normal\", …");
  type.def_readonly("reason", &JudgedAnswer::reason, "Why there is no answer; else empty.");
  const auto error = [&](const char* name, std::optional<double> Score::*member, const char* text) {
    type.def_property_readonly(
        name, [member](const JudgedAnswer& s) { return s.score.*member; }, text);
  };
  error("depth_error", &Score::depth_error, "Answered − true signed distance; positive: shallow.");
  error(
      "normal_regret", &Score::normal_regret,
      "How much deeper the bodies are along the answered normal than along the best one; a large\n"
      "body counts as a half-space, as far as the small one reaches.");
  error("whole_regret", &Score::whole_regret, "The same against the whole bodies.");
  error("normal_angle", &Score::normal_angle, "Degrees to the nearest optimal normal.");
  error("deepest_error", &Score::deepest_error, "Depth of the deepest point − true depth.");
  error("point_error", &Score::point_error,
        "How far the worst point is outside a body, beyond its own depth.");
  error("coverage", &Score::coverage, "Share of the contact patch that the points span, 0 to 1.");
  type.def_property_readonly(
      "severity", [](const JudgedAnswer& s) { return s.score.severity; },
      "The largest of the errors of depth, its points and the normal; 0 is perfect.");
  type.def("__repr__", [](const JudgedAnswer& s) {
    return std::string("<touchstone.Score: ") + outcome_name(s.score.outcome) +
           (s.reason.empty() ? "" : ", " + s.reason) + ">";
  });

  define(m, "score", &score_of, R"(score(configuration, answer, tolerance=1e-4, threshold=0.0)

Returns the Score of an answer: a Contact, None (no contact), or NotImplemented (no routine).

It agrees if the errors of depth, normal and points are within `tolerance`, and a contact is
reported up to `threshold` metres apart.

>>> c = touchstone.Configuration.of("cylinder-sphere/general-shallow/1/0")
>>> touchstone.score(c, touchstone.contact(c.a, c.pose_a, c.b, c.pose_b)).outcome
'agree'
>>> touchstone.score(c, None).outcome
'missed'
)",
         py::arg("configuration"), py::arg("answer"), py::arg("tolerance") = Bar{}.tolerance,
         py::arg("threshold") = Bar{}.threshold);
  define(m, "scores", &scores_of, R"(scores(configurations, answers, tolerance=1e-4, threshold=0.0)

Returns a list with the Score of each answer to the configuration of the same place.
)",
         py::arg("configurations"), py::arg("answers"), py::arg("tolerance") = Bar{}.tolerance,
         py::arg("threshold") = Bar{}.threshold);
}

}  // namespace touchstone::python
