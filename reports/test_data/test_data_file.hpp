#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "reports/test_data/test_data.hpp"

namespace touchstone {

/// The form of a file of test data (docs/suite.md says what each holds).
enum class TestDataFormat { json_lines, csv, npz };
/// Reads "jsonl", "csv" or "npz". Throws InvalidInput with this field.
TestDataFormat parse_test_data_format(std::string_view name, const char* field);

/// Which members a row of CSV has.
enum class CsvColumns {
  all,
  suite  ///< without the numbers of the patch, whose last bits differ by processor
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
