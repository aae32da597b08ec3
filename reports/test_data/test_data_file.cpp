#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "oracle/judge/cast_score.hpp"
#include "oracle/patch/contact_patch.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/configuration_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/test_data/npz_file.hpp"
#include "reports/test_data/small_numbers.hpp"
#include "reports/test_data/suite_2_casts.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

class JsonLinesWriter : public TestDataWriter {
 public:
  std::string add(const TestDatum& d) override {
    const json line = {{"id", to_string(d.identity)},
                       {"group", group_name(d.identity.pose_class.group())},
                       {"configuration", to_json(d.configuration)},
                       {"signed_distance", d.truth.signed_distance.midpoint()},
                       {"signed_distance_error", midpoint_error(d.truth.signed_distance)},
                       {"truth", to_json(d.configuration, d.truth)},
                       {"limits",
                        {{"contact", contact_name(d.limits.contact)},
                         {"min_distance", d.limits.min_distance},
                         {"max_distance", d.limits.max_distance},
                         {"max_regret", d.limits.max_regret},
                         {"min_point_depth", d.limits.min_point_depth}}}};
    return line.dump() + '\n';
  }
};

/// Sizes of body B; what a shape has fewer of is zero.
struct SizesOfB {
  using Sizes = std::array<double, 4>;
  Sizes operator()(const Plane& s) const {
    return {s.normal().x(), s.normal().y(), s.normal().z(), s.displacement()};
  }
  Sizes operator()(const Sphere& s) const { return {s.radius()}; }
  Sizes operator()(const Capsule& s) const { return {s.radius(), s.half_length()}; }
  Sizes operator()(const Cylinder& s) const { return {s.radius(), s.half_length()}; }
  Sizes operator()(const Box& s) const {
    return {s.half_extents().x(), s.half_extents().y(), s.half_extents().z()};
  }
  Sizes operator()(const Convex&) const { return {}; }  // its vertices stand elsewhere
};

/// "box" of cylinder-box.
const char* shape_of_b(Pair pair) { return std::strchr(pair_name(pair), '-') + 1; }

void append(std::vector<double>& numbers, const Vec3& v) {
  for (int i = 0; i < 3; ++i) numbers.push_back(v[i]);
}

template <class Fields>
void put_pose(const std::string& body, const Pose& pose, Fields& fields) {
  const auto& q = pose.orientation();
  std::vector<double> position;
  append(position, pose.position());
  fields.numbers("position_" + body, "xyz", position);
  fields.numbers("orientation_" + body, "wxyz", {q.w(), q.x(), q.y(), q.z()});
}

template <class Fields>
void put_patches(const TestDatum& d, CsvColumns columns, Fields& fields) {
  std::vector<std::string> kinds;
  std::vector<double> areas, perimeters, centroids;
  for (const auto& normal : d.truth.normals) {
    const oracle::ContactPatch patch = oracle::contact_patch(d.configuration, normal);
    kinds.emplace_back(patch_kind_name(patch.kind()));
    areas.push_back(patch.area());
    perimeters.push_back(patch.perimeter());
    append(centroids, patch.centroid());
  }
  fields.texts("patch_kind", kinds);
  if (columns != CsvColumns::all) return;
  fields.vectors("patch_area", 1, areas);
  fields.vectors("patch_perimeter", 1, perimeters);
  fields.vectors("patch_centroid", 3, centroids);
}

/// Both bodies and their poses, which every file begins with.
template <class Fields>
void put_bodies(const std::string& id, Group group, const Configuration& c, Fields& fields) {
  fields.text("id", id);
  fields.text("group", group_name(group));
  fields.numbers("radius_a", "", {c.a.radius()});
  fields.numbers("half_length_a", "", {c.a.half_length()});
  put_pose("a", c.pose_a, fields);
  fields.text("shape_b", shape_of_b(pair_of(c)));
  const auto sizes = std::visit(SizesOfB{}, c.b);
  fields.numbers("size_b", "1234", {sizes.begin(), sizes.end()});
  put_pose("b", c.pose_b, fields);
}

template <class Fields>
void put_normals(const oracle::Truth& truth, Fields& fields) {
  fields.text("ties", ties_name(truth.ties));
  fields.lists_of(truth.normals.size());
  std::vector<double> normals;
  for (const auto& normal : truth.normals) append(normals, normal.n);
  for (double& x : normals) {
    if (std::abs(x) < negligible_component) x = 0;
  }
  fields.vectors("normal", 3, normals);
}

std::string vertices_of_b(const Configuration& c) {
  std::vector<std::string> vertices;
  if (const auto* const convex = std::get_if<Convex>(&c.b)) {
    for (const Vec3& v : convex->vertices()) {
      vertices.push_back(fmt::format("{} {} {}", v.x(), v.y(), v.z()));
    }
  }
  return vertices.empty() ? "none" : fmt::format("{}", fmt::join(vertices, ";"));
}

/// Hands over the columns of CSV and the arrays of NumPy in their order: a text, numbers with a
/// letter for each (none for a single one), then lists with as many members as there are normals.
template <class Fields>
void put_fields(const TestDatum& d, CsvColumns columns, Fields& fields) {
  const Configuration& c = d.configuration;
  const auto number = [&](const char* name, double value) { fields.numbers(name, "", {value}); };
  put_bodies(to_string(d.identity), d.identity.pose_class.group(), c, fields);
  number("signed_distance", d.truth.signed_distance.midpoint());
  number("signed_distance_error", midpoint_error(d.truth.signed_distance));
  const auto [low, high] = decimals(d.truth.signed_distance);
  fields.text("signed_distance_low", low);
  fields.text("signed_distance_high", high);
  fields.text("contact", contact_name(d.limits.contact));
  number("min_distance", d.limits.min_distance);
  number("max_distance", d.limits.max_distance);
  number("max_regret", d.limits.max_regret);
  number("min_point_depth", d.limits.min_point_depth);
  put_normals(d.truth, fields);
  put_patches(d, columns, fields);
  if (columns != CsvColumns::suite_2) return;
  fields.text("vertices_b", vertices_of_b(c));
  number("float_tolerance", d.limits.max_regret + moved_by_rounding(c));
  std::string sentence = d.identity.pose_class.description();
  std::replace(sentence.begin(), sentence.end(), ',', ';');  // no cell needs quotes
  fields.text("about", sentence);
}

/// A row of CSV and the header above it. Numbers are the shortest decimals that give the same
/// doubles back; of a list, members are separated by semicolons and their numbers by spaces, so
/// that no cell needs quotes.
class CsvRow {
 public:
  void text(const std::string& name, const std::string& value) { put(name, value); }
  void numbers(const std::string& name, const std::string& letters,
               const std::vector<double>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      put(letters.empty() ? name : name + '_' + letters[i], fmt::format("{}", values[i]));
    }
  }
  void lists_of(std::size_t) {}
  void texts(const std::string& name, const std::vector<std::string>& values) {
    put(name, fmt::format("{}", fmt::join(values, ";")));
  }
  void vectors(const std::string& name, std::size_t width, const std::vector<double>& values) {
    std::string cell;
    for (std::size_t i = 0; i < values.size(); ++i) {
      cell += fmt::format("{}{}", i == 0 ? "" : i % width == 0 ? ";" : " ", values[i]);
    }
    put(name, cell);
  }
  const std::string& header() const { return header_; }
  const std::string& row() const { return row_; }

 private:
  void put(const std::string& name, const std::string& cell) {
    header_ += (header_.empty() ? "" : ",") + name;
    row_ += (row_.empty() ? "" : ",") + cell;
  }
  std::string header_, row_;
};

/// Rows beneath their header. A file of touchstone-suite-2 begins with its licence and ends with
/// how many they are, so that readers know one that is cut off.
class CsvFile {
 public:
  explicit CsvFile(bool is_suite_2) : is_suite_2_(is_suite_2) {}
  std::string add(const CsvRow& row) {
    std::string text;
    if (count_++ == 0) {
      if (is_suite_2_) text = "# SPDX-License-Identifier: CC0-1.0\n";
      text += row.header() + '\n';
    }
    return text + row.row() + '\n';
  }
  std::string finish() const {
    return is_suite_2_ ? fmt::format("# {} configurations\n", count_) : "";
  }

 private:
  bool is_suite_2_;
  int count_ = 0;
};

class CsvWriter : public TestDataWriter {
 public:
  explicit CsvWriter(CsvColumns columns)
      : columns_(columns), file_(columns == CsvColumns::suite_2) {}
  std::string add(const TestDatum& d) override {
    CsvRow row;
    put_fields(d, columns_, row);
    return file_.add(row);
  }
  std::string finish() override { return file_.finish(); }

 private:
  CsvColumns columns_;
  CsvFile file_;
};

void put_limits(const std::string& prefix, const CastLimits& limits, CsvRow& row) {
  row.text(prefix + "touch", contact_name(limits.touch));
  row.numbers(prefix + "tolerance", "", {limits.tolerance});
  row.numbers(prefix + "min_fraction", "", {limits.min_fraction});
  row.numbers(prefix + "max_fraction", "", {limits.max_fraction});
}

CsvRow row_of(const CastDatum& d) {
  const auto& [configuration, sweep] = d.cast;
  const auto& [status, fraction, there] = d.truth;
  CsvRow row;
  put_bodies(d.id, d.group, configuration, row);
  row.numbers("sweep", "xyz", {sweep.x(), sweep.y(), sweep.z()});
  row.text("outcome", status_name(status));
  row.numbers("fraction", "", {fraction.hi.get_d()});
  const auto [low, high] = decimals(fraction);
  row.text("fraction_low", low);
  row.text("fraction_high", high);
  const bool is_inside = status == oracle::FirstTouch::Status::from_start;
  row.numbers("start_depth", "", {is_inside ? -there->signed_distance.midpoint() + 0.0 : 0.0});
  put_limits("", d.limits, row);
  if (there) {
    put_normals(*there, row);
  } else {
    row.text("ties", "none");
    row.text("normal", "none");
  }
  row.text("vertices_b", vertices_of_b(configuration));
  put_limits("float_", d.float_limits, row);
  row.text("about", d.about);
  return row;
}

class NumPyWriter : public TestDataWriter {
 public:
  std::string add(const TestDatum& d) override {
    put_fields(d, CsvColumns::all, file_);
    return {};
  }
  std::string finish() override { return file_.bytes(); }

 private:
  NpzFile file_;
};

}  // namespace

std::string cast_csv(const std::vector<CastDatum>& casts) {
  CsvFile file(true);
  std::string text;
  for (const CastDatum& cast : casts) text += file.add(row_of(cast));
  return text + file.finish();
}

TestDataFormat parse_test_data_format(std::string_view name, const char* field) {
  if (name == "jsonl") return TestDataFormat::json_lines;
  if (name == "csv") return TestDataFormat::csv;
  if (name == "npz") return TestDataFormat::npz;
  throw InvalidInput(field, '"' + std::string(name) + '"', "must be one of jsonl, csv, npz");
}

std::unique_ptr<TestDataWriter> test_data_writer(TestDataFormat format, CsvColumns columns) {
  switch (format) {
    case TestDataFormat::json_lines:
      return std::make_unique<JsonLinesWriter>();
    case TestDataFormat::csv:
      return std::make_unique<CsvWriter>(columns);
    case TestDataFormat::npz:
      return std::make_unique<NumPyWriter>();
  }
  return nullptr;
}

}  // namespace touchstone
