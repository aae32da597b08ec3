#include "reports/solve.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <fmt/format.h>
#include <istream>
#include <limits>
#include <ostream>
#include <string>

#include <nlohmann/json.hpp>

#include "candidates/host/worker_processes.hpp"
#include "candidates/readable.hpp"
#include "properties/files/answer_json.hpp"
#include "properties/files/bytes.hpp"
#include "properties/files/configuration_json.hpp"
#include "properties/files/given_text.hpp"
#include "properties/files/strict_json.hpp"
#include "reference/invalid_input.hpp"
#include "reports/examine_cast.hpp"
#include "reports/test_data/test_data.hpp"

namespace touchstone {
namespace {

using nlohmann::json;

/// An end that overflowed is null: it bounds nothing.
json end_of(double value, std::string (*decimal)(const mpq_class&, int)) {
  return std::isfinite(value) ? json(decimal(mpq_class(value), 17)) : json(nullptr);
}

json exact(const audit::RationalVector& v) {
  return json::array({v[0].get_str(), v[1].get_str(), v[2].get_str()});
}
json exact(const audit::RationalPair& pair) {
  json weights;
  for (const auto& [vertex, weight] : pair.weights) {
    weights[std::to_string(vertex)] = weight.get_str();
  }
  return {{"a", exact(pair.a)}, {"b", pair.weights.empty() ? exact(pair.b) : weights}};
}

bool is_above(double value, const mpq_class& exact) {
  return std::isfinite(value) ? mpq_class(value) > exact : value > 0;
}
bool is_below(double value, const mpq_class& exact) {
  return std::isfinite(value) ? mpq_class(value) < exact : value < 0;
}

}  // namespace

void check_agreement(const Configuration& configuration, const oracle::Enclosure& truth,
                     const audit::Enclosure& audit) {
  if (!is_above(audit.lo, truth.hi) && !is_below(audit.hi, truth.lo) &&
      !is_below(audit.pair_distance, truth.lo)) {
    return;
  }
  throw Contradiction(fmt::format(
      "the oracles contradict each other: the first encloses the signed distance in [{}, {}], the "
      "second in [{:.17g}, {:.17g}] with two points {:.17g} apart, for {}",
      oracle::decimal_below(truth.lo, 20), oracle::decimal_above(truth.hi, 20), audit.lo, audit.hi,
      audit.pair_distance, to_hex_json(configuration).dump()));
}

json to_json(const audit::Enclosure& audit) {
  const double difference = audit.pair_distance - audit.lo;
  const double primal_dual =
      difference > 0 ? std::nextafter(difference, std::numeric_limits<double>::infinity()) : 0;
  return {{"signed_distance",
           {end_of(audit.lo, oracle::decimal_below), end_of(audit.hi, oracle::decimal_above)}},
          {"primal_dual_gap",
           audit.lo > 0 && std::isfinite(primal_dual) ? json(primal_dual) : json(nullptr)}};
}

std::string certificate_json(const audit::Certificate& certificate,
                             const Configuration& configuration) {
  const double size = larger_size(configuration);
  const mpq_class width = (certificate.hi - certificate.lo) / mpq_class(size);
  json result = {{"schema", "touchstone-certificate-1"},
                 {"configuration", to_hex_json(configuration)},
                 {"exact", to_exact_json(configuration)},
                 {"signed_distance", {certificate.lo.get_str(), certificate.hi.get_str()}},
                 {"grain", certificate.grain.get_str()},
                 {"width", width.get_d()},
                 {"normal", exact(certificate.normal)}};
  if (certificate.pair) {
    result["pair"] = exact(*certificate.pair);
    return result.dump();
  }
  result["cells"] = json::array();
  for (const auto& cell : certificate.cells) {
    result["cells"].push_back(exact(cell.pair));
    result["cells"].back()["cell"] = cell.path;
  }
  return result.dump();
}

std::string certificate_json(const audit::CastCertificate& certificate,
                             const Configuration& configuration, const Sweep& sweep) {
  const auto exact_vector = [](const Vec3& v) {
    return exact(audit::RationalVector{mpq_class(v.x()), mpq_class(v.y()), mpq_class(v.z())});
  };
  json exact_input = to_exact_json(configuration);
  exact_input["sweep"] = exact_vector(sweep.translation());
  if (sweep.turns()) exact_input["spin"] = exact_vector(sweep.spin());
  json result = {{"schema", "touchstone-cast-certificate-1"},
                 {"configuration", to_hex_json(configuration, sweep)},
                 {"exact", exact_input},
                 {"apart", json::array()}};
  for (const auto& [until, normal] : certificate.apart) {
    result["apart"].push_back({{"until", until.get_str()}, {"normal", exact(normal)}});
  }
  if (certificate.pair) {
    result["pair"] = exact(*certificate.pair);
    result["distance"] = certificate.distance.get_str();
  }
  return result.dump();
}

namespace {

/// What a line of input has for an answer: itself as JSON, and the truth.
struct SolvedLine {
  json answer;
  oracle::Enclosure signed_distance;
};

SolvedLine solved(const json& line, const SolveOptions& options,
                  std::vector<CandidateProcess>& candidates) {
  if (line.contains("id")) id_of(line);  // has to be one
  const GivenConfiguration given =
      cast_from_json(line.contains("configuration") ? line["configuration"] : line);
  const Configuration& c = given.configuration;
  const Order order = given.swapped ? Order::swapped : Order::as_ours;
  if (given.sweep && options.csv) {
    throw InvalidInput("sweep", "given",
                       "must be left out beside --csv, which has no columns for it");
  }
  const oracle::Truth truth = oracle::truth(c, options.width);
  json result;
  if (line.contains("id")) result["id"] = line["id"];
  result["truth"] = to_json(c, truth, order);
  if (options.audit) {
    const audit::Enclosure enclosure = audit::enclose(c);
    check_agreement(c, truth.signed_distance, enclosure);
    result["audit"] = touchstone::to_json(enclosure);
  }
  result["answers"] = json::object();
  for (CandidateProcess& process : candidates) {
    const Answer a = process.answer(c);
    result["answers"][process.candidate().name] =
        to_json(a, score(c, truth, a, options.bar), order);
  }
  if (given.sweep) {
    result["cast"] =
        touchstone::to_json(examine_cast(c, *given.sweep, options.candidates, options.bar), order);
  }
  return {result, truth.signed_distance};
}

json error(std::size_t number, const json& line, const InvalidInput& e) {
  constexpr std::size_t max_field = 200;
  json result = {
      {"line", number}, {"field", printable(e.field(), max_field)}, {"error", error_text(e)}};
  if (line.contains("id") && line["id"].is_primitive()) result["id"] = line["id"];
  return result;
}

// As CSV. What test data have, too, is called as it is there (test_data_file.cpp).

constexpr const char* csv_columns[] = {"line",
                                       "id",
                                       "candidate",
                                       "signed_distance",
                                       "signed_distance_error",
                                       "signed_distance_low",
                                       "signed_distance_high",
                                       "ties",
                                       "normal",
                                       "status",
                                       "answered_distance",
                                       "answered_normal",
                                       "points",
                                       "outcome",
                                       "depth_error",
                                       "normal_regret",
                                       "whole_regret",
                                       "normal_angle",
                                       "point_error",
                                       "deepest_error",
                                       "coverage",
                                       "error"};

/// A list's members are separated by semicolons, their numbers by spaces. A text stands in quotes
/// where it has to (RFC 4180).
std::string cell_of(const json& value) {
  if (value.is_null()) return "";
  if (value.is_array()) {
    std::string text;
    for (const json& each : value) {
      text += text.empty() ? "" : each.is_array() ? ";" : " ";
      text += each.is_null() ? "nan" : cell_of(each);
    }
    return text;
  }
  if (!value.is_string()) return value.dump();
  std::string text = escaped(value.get<std::string>());
  if (text.find_first_of(",\"\r\n") == text.npos) return text;
  for (std::size_t at = 0; (at = text.find('"', at)) != text.npos; at += 2) text.insert(at, 1, '"');
  return '"' + text + '"';
}

/// A row; what it has no member for is empty.
std::string solved_row(const json& members) {
  std::string row;
  for (const char* column : csv_columns) {
    if (!row.empty() || column != csv_columns[0]) row += ',';
    if (members.contains(column)) row += cell_of(members[column]);
  }
  return row + '\n';
}

std::string solved_rows(json row, const SolvedLine& solved, const SolveOptions& options) {
  const json& truth = solved.answer["truth"];
  row["signed_distance"] = solved.signed_distance.midpoint();
  row["signed_distance_error"] = midpoint_error(solved.signed_distance);
  row["signed_distance_low"] = truth["signed_distance"][0];
  row["signed_distance_high"] = truth["signed_distance"][1];
  row["ties"] = truth["ties"];
  row["normal"] = truth["normals"];
  for (json& normal : row["normal"]) {
    for (json& x : normal) {
      if (std::abs(x.get<double>()) < negligible_component) x = 0.0;
    }
  }
  std::string rows;
  for (const Candidate* candidate : options.candidates) {
    const json& answer = solved.answer["answers"][candidate->name];
    json own = row;
    own.update(answer["score"]);
    own["candidate"] = candidate->name;
    own["status"] = answer["status"];
    own["answered_distance"] = answer["signed_distance"];
    own["answered_normal"] = answer["normal"];
    own["points"] = answer["points"].size();
    own["error"] = answer.value("reason", json());
    rows += solved_row(own);
  }
  return rows;
}

/// Lines that a candidate is asked in one session, on which an answer may depend. They are the same
/// whatever the number of workers.
constexpr std::size_t session_lines = 256;

/// Answers lines, in the process that it is used in.
class Solver {
 public:
  explicit Solver(const SolveOptions& options)
      : options_(options), candidates_(options.candidates, options.bar.threshold, options.limits) {}

  /// The answer to a line, with its end. It is the `index`-th that counts in its input, from 0.
  std::string answer(const JsonLines& line, std::size_t index) {
    if (index % session_lines == 0) {
      for (CandidateProcess& process : candidates_.get()) process.restart();
    }
    json given;
    try {
      given = line.parse();
      const SolvedLine result = solved(given, options_, candidates_.get());
      if (options_.csv) return solved_rows(csv_start(given, line.number()), result, options_);
      return text_of(result.answer);
    } catch (const InvalidInput& e) {
      is_good_ = false;
      const json result = error(line.number(), given, e);
      if (!options_.csv) return text_of(result);
      json row = csv_start(result, line.number());
      row["error"] = result["error"];
      return solved_row(row);
    }  // Anything else is our own contradiction and ends the program.
  }
  /// Could all lines be answered?
  bool is_good() const { return is_good_; }

 private:
  static std::string text_of(const json& result) {
    return escaped(result.dump(-1, ' ', false, json::error_handler_t::replace)) + '\n';
  }
  /// What every row of a line has.
  static json csv_start(const json& line, std::uint64_t number) {
    json row = {{"line", number}};
    if (line.contains("id")) row["id"] = id_of(line);
    return row;
  }

  const SolveOptions& options_;
  WorkerCandidates candidates_;
  bool is_good_ = true;
};

/// The next lines, up to so many. What ends the input for a reason is thrown once the lines before
/// it are answered.
std::vector<JsonLines> next_lines(JsonLines& lines, std::size_t count, std::exception_ptr& reason) {
  std::vector<JsonLines> result;
  try {
    while (result.size() < count && lines.next()) result.push_back(lines);
  } catch (const InvalidInput&) {
    reason = std::current_exception();
  }
  return result;
}

/// In each worker whole sessions.
bool solve_in_workers(JsonLines& lines, std::ostream& out, const SolveOptions& options) {
  constexpr std::size_t sessions_of_worker = 32;  // before workers are started anew
  bool good = true;
  std::exception_ptr reason;
  while (out && !reason) {
    const std::vector<JsonLines> block =
        next_lines(lines, options.workers * sessions_of_worker * session_lines, reason);
    if (block.empty()) break;
    Solver solver(options);
    const auto task = [&](std::uint64_t session) {
      std::string text;
      const std::size_t first = session * session_lines;
      for (std::size_t i = first; i < std::min(first + session_lines, block.size()); ++i) {
        text += solver.answer(block[i], i);
      }
      BytesOut bytes;
      bytes(solver.is_good(), text);
      return bytes.take();
    };
    const auto name = [&](std::uint64_t session) {
      return fmt::format("line {} or after it", block[session * session_lines].number());
    };
    const auto take = [&](const std::string& bytes) {
      BytesIn in(bytes);
      good = in.next<bool>() && good;
      out << in.next<std::string>() << std::flush;
    };
    stream_in_order((block.size() + session_lines - 1) / session_lines, options.workers, task, name,
                    take, [&] { return out.good(); });
  }
  if (reason) std::rethrow_exception(reason);
  return good;
}

}  // namespace

bool solve(std::istream& in, std::ostream& out, const SolveOptions& options) {
  if (options.csv) out << fmt::format("{}\n", fmt::join(csv_columns, ","));
  JsonLines lines(in);
  if (options.workers > 1) return solve_in_workers(lines, out, options);
  Solver solver(options);
  for (std::size_t index = 0; lines.next(); ++index) {
    out << solver.answer(lines, index) << std::flush;
    if (!out) break;  // nobody would see the other answers
  }
  return solver.is_good();
}

}  // namespace touchstone
