#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/judge/score.hpp"
#include "oracle/truth.hpp"
#include "properties/identity.hpp"
#include "reports/campaign.hpp"

namespace touchstone {

// Configurations with their truths, for those who test elsewhere (docs/your-poses.md).

/// The numbers that score() compares an answer with, metres.
struct AnswerLimits {
  enum class Contact { required, optional, forbidden };

  Contact contact;
  double min_distance, max_distance;  ///< of the signed distance
  double max_regret;                  ///< of the normal
  double min_point_depth;             ///< of every contact point
};
AnswerLimits answer_limits(const Configuration& configuration, const oracle::Truth& truth,
                           const Bar& bar);
/// "required", "optional", "forbidden"
const char* contact_name(AnswerLimits::Contact contact);

/// Error of the signed distance as a double (Enclosure::midpoint), metres, rounded up.
double midpoint_error(const oracle::Enclosure& signed_distance);

/// Components of a normal below this are written as zero: what is left of one that is zero depends
/// on how the oracle has found the normal.
inline constexpr double negligible_component = 1e-30;

/// One configuration of a file of test data.
struct TestDatum {
  Identity identity;
  Configuration configuration;
  oracle::Truth truth;
  AnswerLimits limits;
};

/// touchstone-suite-1: of every pair and pose class of a default report, 3 configurations; of
/// everyday and recorded classes and of arrangements along the world's axes, 15.
Campaign suite_1();

/// A file of touchstone-suite-2, whose configurations are exact in single precision.
struct SuiteFile {
  std::string_view name;  ///< "smoke", "everyday", "hard"
  std::vector<Group> groups;
  std::size_t of_each;  ///< configurations of each pair and group
  bool is_small;        ///< are numbers of few digits preferred?
};
const std::vector<SuiteFile>& suite_2_files();
/// Hands over the configurations of a file in their order. Each is that of its identity with all
/// numbers rounded to floats, so that the bodies meet as they did; the truth is that of the floats.
void make_suite_2(const SuiteFile& file, const std::function<void(const TestDatum&)>& take);

/// Those of all configurations that a campaign selects, in report order.
std::vector<Identity> identities(const Campaign& campaign);

/// Hands over the test data of a campaign's configurations, in their order; the truths are computed
/// in its workers. Ends early, without the rest, on an interruption (interruption.hpp). Throws like
/// sample().
void make_test_data(const Campaign& campaign, const std::function<void(const TestDatum&)>& take);

/// The form of a file of test data (docs/your-poses.md says what each holds).
enum class TestDataFormat { json_lines, csv, npz };
/// Reads "jsonl", "csv" or "npz". Throws InvalidInput with this field.
TestDataFormat parse_test_data_format(std::string_view name, const char* field);

/// Which members a row of CSV has.
enum class CsvColumns {
  all,
  suite,   ///< without the numbers of the patch, whose last bits differ by processor
  suite_2  ///< with what single precision, hulls and readers need, beneath a licence
};

/// Writes test data as text, one piece after the other.
class TestDataWriter {
 public:
  virtual ~TestDataWriter() = default;
  /// What the datum adds to the file.
  virtual std::string add(const TestDatum& datum) = 0;
  /// What ends the file. Throws InvalidInput (field "--count") if it would be too large for its
  /// form.
  virtual std::string finish() { return {}; }
};
std::unique_ptr<TestDataWriter> test_data_writer(TestDataFormat format,
                                                 CsvColumns columns = CsvColumns::all);

}  // namespace touchstone
