#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "candidates/host/candidate_process.hpp"
#include "oracle/judge/score.hpp"
#include "properties/identity.hpp"
#include "reports/campaign.hpp"
#include "reports/examine_cast.hpp"
#include "reports/report.hpp"
#include "reports/terminal.hpp"

namespace touchstone {

/// Examines one configuration, as in a report's worst cases and `replay`: each candidate answers in
/// a new session. `width`: of the truth, relative to the larger size.
Examination examine(const Subject& subject, std::span<CandidateProcess* const> candidates,
                    const Bar& bar, double width = truth_width);

// An examination shown to a person. `description` is that of its pose class; empty without one.
// Precondition: the examination has its truth.

/// A table of the truth and each candidate's answer. `in_full`: also all digits of the truth, all
/// of each candidate's answer and score, and last the configuration's numbers (as a line for
/// `solve`, as exact fractions, in hexadecimal floats), whose lines alone are longer than the
/// terminal's.
std::string replay_text(const Examination& examination, const std::string& description,
                        bool in_full, const Terminal& terminal = {});

/// One JSON object, as in a report's worst cases; of a cast with the member "cast", too.
std::string replay_json(const Examination& examination,
                        const std::optional<CastExamination>& cast = {});

/// One self-contained page: both bodies in three dimensions and in a slice through the contact,
/// with the contact points and normals of truth and candidates, and all numbers. Of a cast, A is
/// moved along its sweep by a slider, to the fractions of the truth and of candidates. Nothing is
/// loaded from elsewhere.
std::string replay_page(const Examination& examination, const std::string& description,
                        const std::optional<CastExamination>& cast = {});

/// A page's data with what its script asks of candidates: their marks, which do not run as native
/// code, and how the program is started so that it knows each. `runs`: how each runs, by name.
nlohmann::json with_candidates(nlohmann::json data, const std::map<std::string, std::string>& runs);

/// The double nearest to the middle of an enclosure: -2 where bounds of 1e-30 lie about it.
double nearest_to_middle(const oracle::Enclosure& enclosure);

/// Engines that a program can be written for that needs nothing of ours: "bullet", "jolt", …
std::vector<std::string> reproducer_engines();

/// A program that asks this engine alone, called as the candidate of that name is (libccd as
/// libccd-gjk), and needs nothing of ours; for the name of any other candidate one that asks its
/// plug-in or command once. With a sweep (metres, world) it asks for that cast. It prints the
/// answer and what is true, with a proof, and exits with 1 while the answer does not agree within
/// the bar. Its comment says how to run it, and what the candidate answered here and now. `asked`
/// names the configuration there.
///
/// `language`: "c++", "javascript" or "python", of those that there are for the engine; empty for
/// the usual one. Jolt's in C++ is a test case for its own unit tests, which looks at no points.
///
/// Throws InvalidInput (field "--emit") for an engine that is not known, has no routine for the
/// pair, or no program for casts, and (field "--language") for another language.
std::string reproducer(std::string_view engine, std::string_view language,
                       const Configuration& configuration, const std::optional<Vec3>& sweep,
                       const std::string& asked, const Bar& bar, const Limits& limits = {});

// Commands that a person would repeat.

/// Quotes a word for a shell; left alone where it needs no quotes.
std::string shell_quoted(const std::string& text);

/// "./touchstone" in a clone, otherwise "touchstone", with all options that added candidates.
std::string program_name();
/// The same with those that added these.
std::string program_name(const std::vector<std::string>& candidates);

/// "./touchstone replay cylinder-box/rim-face/1/17", which these candidates have to answer.
std::string replay_command(const std::string& name, const std::vector<std::string>& candidates);
/// Likewise for one of a file, by its id there if it has one.
std::string replay_command(const Subject& subject, const std::vector<std::string>& candidates);
/// "echo '{…}' | ./touchstone replay -", which knows these candidates: for a configuration without
/// an identity, every number as a hexadecimal float.
std::string piped_to_replay(const Configuration& configuration, const std::optional<Vec3>& sweep,
                            const std::vector<std::string>& candidates);
/// Likewise, and these candidates have to answer.
std::string replay_command(const Configuration& configuration,
                           const std::vector<std::string>& candidates);

}  // namespace touchstone
