#include "candidates/host/messages.hpp"

#include <algorithm>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <set>
#include <vector>

#include <nlohmann/json.hpp>

namespace touchstone::messages {
namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little,
              "frames are copied as they lie in memory");

constexpr std::size_t header_size = 24, length_size = 4;
constexpr std::size_t cast_bytes = 40;  // status, nothing, fraction, normal
constexpr std::size_t point_size = 56, answer_bytes = 48 + TOUCHSTONE_MAX_POINTS * point_size;
static_assert(sizeof(ts_point) == point_size);

/// Throws Garbage.
[[noreturn]] void refuse(const std::string& why) { throw Garbage(why); }

// Hello

constexpr const char* pairs_text =
    "\"cylinder-plane\", \"cylinder-sphere\", \"cylinder-capsule\", \"cylinder-cylinder\", "
    "\"cylinder-box\", \"cylinder-convex\"";
constexpr const char* shape_names[] = {"cylinder", "plane", "sphere", "capsule", "box", "convex"};
static_assert(std::size(shape_names) == shape_kinds);

/// Levels of a message, as of other JSON (docs/your-poses.md); printing deeper ones would take the
/// stack.
constexpr int max_depth = 64;

Json parsed(const std::string& line) {
  bool is_deeper = false;
  std::vector<std::set<std::string>>
      members;  // of the objects around what is read, outermost first
  std::optional<std::string> twice;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& value) {
    const bool begins =
        event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    is_deeper = is_deeper || (begins && depth >= max_depth);
    if (is_deeper) return false;
    const auto level = static_cast<std::size_t>(depth);
    if (event == Json::parse_event_t::object_start) {
      members.resize(level + 1);
      members.emplace_back();
    } else if (event == Json::parse_event_t::key) {
      auto name = value.get<std::string>();
      if (!members[level].insert(name).second) twice = std::move(name);
    }
    return true;
  };
  Json json = Json::parse(line, watch, false);
  if (is_deeper) {
    refuse("it wrote " + quoted(line) + ", which is more than " + std::to_string(max_depth) +
           " levels deep");
  }
  if (twice) refuse("it wrote the member " + messages::quoted(*twice) + " twice");
  if (!json.is_object()) refuse("it wrote " + quoted(line) + ", which is no JSON object");
  return json;
}

[[noreturn]] void refuse_member(const char* name, const Json& value, const std::string& remedy) {
  refuse("its hello has \"" + std::string(name) +
         "\": " + (value.is_null() ? "nothing" : quoted(value.dump(-1, ' ', true))) +
         ", which must be " + remedy);
}

std::string text_member(const Json& json, const char* name, bool required) {
  const Json value = json.value(name, Json());
  if (value.is_null() && !required) return "";
  if (!value.is_string()) refuse_member(name, value, "a text");
  return value.get<std::string>();
}

std::string choice_member(const Json& json, const char* name,
                          std::initializer_list<const char*> of) {
  std::string text = text_member(json, name, true);
  std::string remedy;
  for (const char* choice : of) {
    if (text == choice) return text;
    remedy += (remedy.empty() ? "\"" : " or \"") + std::string(choice) + '"';
  }
  refuse_member(name, text, remedy);
}

void read_parameter(const Json& value, Description& d) {
  const auto bad = [&] {
    refuse_member(
        "parameter", value,
        "like {\"meaning\": \"margin, metres\", \"min\": 0, \"max\": 1, \"usual\": 0.01}, "
        "with min <= usual <= max");
  };
  if (!value.is_object() || !value.value("meaning", Json()).is_string()) bad();
  for (const char* name : {"min", "max", "usual"}) {
    if (!value.value(name, Json()).is_number()) bad();
  }
  if (!value.value("whole", Json(false)).is_boolean()) bad();
  d.has_parameter = true;
  copy_text(value["meaning"].get_ref<const std::string&>().c_str(), d.meaning);
  d.min = value["min"];
  d.max = value["max"];
  d.usual = value["usual"];
  d.whole = value.value("whole", false);
  if (d.meaning[0] == '\0' || !(d.min <= d.usual && d.usual <= d.max)) bad();
}

// Frames

class Writer {
 public:
  explicit Writer(const Request& request, std::uint32_t passes = 0) {
    put(std::uint32_t{0});  // the length, at the end
    put(request.operation);
    put(request.ticket);
    put(request.count);
    put(passes);
  }
  template <class T>
  void put(const T& value) {
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  /// Without vertices, which follow the entries.
  void put(const ts_shape& shape) {
    put(static_cast<std::uint32_t>(shape.kind));
    put(static_cast<std::uint32_t>(shape.vertex_count));
    put(shape.size);
  }
  std::string take() {
    const auto length = static_cast<std::uint32_t>(bytes_.size() - length_size);
    std::memcpy(bytes_.data(), &length, sizeof length);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

class Reader {
 public:
  /// Reads the header.
  Reader(const Request& request, const std::string& bytes) : bytes_(bytes) {
    const std::size_t size = request.answer_size();
    if (bytes.size() != size) {
      refuse("its frame has " + std::to_string(bytes.size()) + " bytes instead of " +
             std::to_string(size));
    }
    expect("length", static_cast<std::uint32_t>(size - length_size));
    expect("operation", static_cast<std::uint32_t>(request.operation));
    expect("ticket", request.ticket);
    expect("count", request.count);
    get<std::uint32_t>();
  }
  template <class T>
  T get() {
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }

 private:
  template <class T>
  void expect(const char* name, T wanted) {
    const T value = get<T>();
    if (value == wanted) return;
    refuse("its frame's " + std::string(name) + " is " + std::to_string(value) + " instead of " +
           std::to_string(wanted));
  }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

Answer get_answer(Reader& in) {
  Answer answer{};
  const auto status = in.get<std::uint32_t>();
  const auto points = in.get<std::uint32_t>();
  if (status > TS_FAILED) refuse("an answer has the status " + std::to_string(status));
  answer.status = static_cast<ts_status>(status);
  answer.signed_distance = in.get<double>();
  for (double& x : answer.normal) x = in.get<double>();
  const auto model_distance = in.get<double>();
  if (!std::isnan(model_distance)) answer.model_distance = model_distance;
  if (answer.status != TS_CONTACT) {
    static_cast<ts_answer&>(answer) = {};
    answer.status = static_cast<ts_status>(status);
    return answer;
  }
  if (points > TOUCHSTONE_MAX_POINTS) {
    refuse("an answer has " + std::to_string(points) + " points, more than " +
           std::to_string(TOUCHSTONE_MAX_POINTS));
  }
  answer.point_count = static_cast<int>(points);
  for (ts_point& point : answer.points) point = in.get<ts_point>();
  return answer;
}

// Lines

/// Numbers go as JSON writes doubles, with as many digits as they need; NaN and infinities, which
/// JSON does not have, as texts.
Json number(double x) {
  if (std::isfinite(x)) return x;
  return std::isnan(x) ? "nan" : x > 0 ? "inf" : "-inf";
}

template <std::size_t size>
Json numbers(const double (&x)[size]) {
  Json result = Json::array();
  for (const double value : x) result.push_back(number(value));
  return result;
}

Json shape_json(const ts_shape& s) {
  const double* const size = s.size;
  Json json = {{"shape", shape_names[s.kind]}};
  if (s.rounding > 0) json["rounding"] = s.rounding;
  switch (s.kind) {
    case TS_CYLINDER:
    case TS_CAPSULE:
      json["half_length"] = size[1];
      [[fallthrough]];
    case TS_SPHERE:
      json["radius"] = size[0];
      break;
    case TS_PLANE:
      json["normal"] = {size[0], size[1], size[2]};
      json["displacement"] = size[3];
      break;
    case TS_BOX:
      json["half_extents"] = {size[0], size[1], size[2]};
      break;
    case TS_CONVEX:
      json["vertices"] = Json::array();
      for (int i = 0; i < s.vertex_count; ++i) {
        const double* const v = s.vertices + std::ptrdiff_t{3} * i;
        json["vertices"].push_back({v[0], v[1], v[2]});
      }
  }
  return json;
}

Json pose_json(const ts_pose& pose) {
  return {{"position", numbers(pose.position)}, {"orientation", numbers(pose.orientation)}};
}

std::string request_line(const Request& request, Json entries, std::uint32_t passes = 0) {
  constexpr const char* names[] = {"", "prepare", "query", "time", "release", "cast"};
  Json json = {{"op", names[static_cast<std::size_t>(request.operation)]},
               {"ticket", request.ticket},
               {"entries", std::move(entries)}};
  if (passes > 0) json["passes"] = passes;
  return json.dump() + '\n';
}

/// The answer in a line. Throws Garbage if it has another ticket.
Json answer_line(const Request& request, const std::string& line) {
  Json json = parsed(line);
  const Json found = json.value("ticket", Json());
  if (!found.is_number_unsigned() || found.get<std::uint64_t>() != request.ticket) {
    refuse("its ticket is " + quoted(found.dump(-1, ' ', true)) + " instead of " +
           std::to_string(request.ticket));
  }
  return json;
}

/// A list of `count` entries. Throws Garbage.
Json list_member(const Json& json, const char* name, std::size_t count) {
  Json list = json.value(name, Json());
  if (!list.is_array() || list.size() != count) {
    refuse("its \"" + std::string(name) + "\" is no list of " + std::to_string(count));
  }
  return list;
}

double number_of(const Json& json, const char* name) {
  if (json.is_number()) return json.get<double>();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (json == "nan") return std::numeric_limits<double>::quiet_NaN();
  if (json == "inf") return infinity;
  if (json == "-inf") return -infinity;
  refuse("its \"" + std::string(name) + "\" is " + quoted(json.dump(-1, ' ', true)) +
         ", which is no number");
}

void get_vector(const Json& json, const char* name, double (&to)[3]) {
  const Json list = list_member(json, name, 3);
  for (std::size_t i = 0; i < 3; ++i) to[i] = number_of(list[i], name);
}

Answer get_answer(const Json& json) {
  if (!json.is_object()) refuse("an answer is no JSON object");
  constexpr const char* names[] = {"contact", "none", "unsupported", "failed"};
  const Json status = json.value("status", Json());
  const auto found = std::find_if(std::begin(names), std::end(names),
                                  [&](const char* name) { return status == name; });
  if (found == std::end(names)) {
    refuse("an answer has the status " + quoted(status.dump(-1, ' ', true)));
  }
  Answer answer{};
  answer.status = static_cast<ts_status>(found - std::begin(names));
  const Json model_distance = json.value("model_distance", Json());
  if (!model_distance.is_null()) {
    const double distance = number_of(model_distance, "model_distance");
    if (!std::isnan(distance)) answer.model_distance = distance;
  }
  if (answer.status != TS_CONTACT) return answer;
  answer.signed_distance = number_of(json.value("signed_distance", Json()), "signed_distance");
  get_vector(json, "normal", answer.normal);
  const Json points = json.value("points", Json());
  if (!points.is_array() || points.size() > TOUCHSTONE_MAX_POINTS) {
    refuse("its \"points\" is no list of up to " + std::to_string(TOUCHSTONE_MAX_POINTS));
  }
  for (const Json& point : points) {
    if (!point.is_object()) refuse("a point is no JSON object");
    ts_point& p = answer.points[answer.point_count++];
    get_vector(point, "position", p.position);
    get_vector(point, "normal", p.normal);
    p.depth = number_of(point.value("depth", Json()), "depth");
  }
  return answer;
}

}  // namespace

std::string quoted(const std::string& text) {
  constexpr std::size_t max_size = 60;
  std::string result = text.substr(0, max_size);
  for (char& c : result) {
    if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
  }
  return '"' + result + (text.size() > max_size ? "\"…" : "\"");
}

std::string hello() { return R"({"touchstone": 1})"; }

Description read_hello(const std::string& line) {
  const Json json = parsed(line);
  const Json version = json.value("touchstone", Json());
  if (version != 1) refuse_member("touchstone", version, "1, the version of this protocol");
  Description d{};
  const std::string name = text_member(json, "name", true);
  if (!is_candidate_name(name)) refuse_member("name", name, candidate_names);
  copy_text(name.c_str(), d.name);
  copy_text(text_member(json, "version", true).c_str(), d.version);
  copy_text(choice_member(json, "precision", {"double", "float"}).c_str(), d.precision);
  copy_text(choice_member(json, "runs", {"native", "wasm", "script"}).c_str(), d.runs);
  copy_text(text_member(json, "settings", true).c_str(), d.settings);
  copy_text(text_member(json, "models", false).c_str(), d.models);
  const Json pairs = json.value("pairs", Json());
  const auto bad_pairs = [&] {
    refuse_member("pairs", pairs, std::string("a list of ") + pairs_text);
  };
  if (!pairs.is_array() || pairs.empty()) bad_pairs();
  for (const Json& pair : pairs) {
    const auto is_named = [&](const char* shape) {
      return pair == std::string("cylinder-") + shape;
    };
    const auto found = std::ranges::find_if(shape_names, is_named);
    if (found == std::end(shape_names)) bad_pairs();
    d.supports[found - std::begin(shape_names)] = true;
  }
  if (json.contains("parameter")) read_parameter(json["parameter"], d);
  const Json roundings = json.value("roundings", Json(false));
  if (!roundings.is_boolean()) refuse_member("roundings", roundings, "true or false");
  d.says_roundings = roundings.get<bool>();
  const Json casts = json.value("casts", Json(false));
  if (!casts.is_boolean()) refuse_member("casts", casts, "true or false");
  d.has_casts = casts.get<bool>();
  d.in_frames = choice_member(json, "format", {"frames", "lines"}) == "frames";
  return d;
}

Request prepare_request(Format format, std::uint64_t ticket, const PairOfShapes& p,
                        bool has_roundings) {
  Request request{format, Operation::prepare, ticket, 1, "", has_roundings};
  if (format == Format::lines) {
    request.text = request_line(request, Json::array({{{"handle", p.handle},
                                                       {"threshold", number(p.threshold)},
                                                       {"parameter", number(p.parameter)},
                                                       {"a", shape_json(p.a)},
                                                       {"b", shape_json(p.b)}}}));
    return request;
  }
  Writer out(request);
  out.put(p.handle);
  out.put(std::uint32_t{0});
  out.put(p.threshold);
  out.put(p.parameter);
  out.put(p.a);
  out.put(p.b);
  for (const double x : coordinates_of(p.b)) out.put(x);
  if (has_roundings) {
    out.put(p.a.rounding);
    out.put(p.b.rounding);
  }
  request.text = out.take();
  return request;
}

namespace {

Request asking(Operation operation, Format format, std::uint64_t ticket,
               std::span<const Poses> poses, std::uint32_t passes = 0) {
  Request request{format, operation, ticket, static_cast<std::uint32_t>(poses.size()), ""};
  const char* const third = operation == Operation::cast ? "sweep" : "hint";
  Writer out(request, passes);
  Json entries = Json::array();
  for (const Poses& p : poses) {
    if (format == Format::lines) {
      entries.push_back({{"handle", p.handle},
                         {"pose_a", pose_json(p.a)},
                         {"pose_b", pose_json(p.b)},
                         {third, p.has_previous_normal ? numbers(p.previous_normal) : Json()}});
      continue;
    }
    out.put(p.handle);
    out.put(std::uint32_t{p.has_previous_normal});
    out.put(p.a);
    out.put(p.b);
    out.put(p.previous_normal);
  }
  request.text =
      format == Format::lines ? request_line(request, std::move(entries), passes) : out.take();
  return request;
}

}  // namespace

Request query_request(Format format, std::uint64_t ticket, std::span<const Poses> poses,
                      std::uint32_t passes) {
  return asking(passes > 0 ? Operation::time : Operation::query, format, ticket, poses, passes);
}

Request cast_request(Format format, std::uint64_t ticket, const Poses& poses) {
  return asking(Operation::cast, format, ticket, {&poses, 1});
}

Request release_request(Format format, std::uint64_t ticket,
                        std::span<const std::uint32_t> handles) {
  Request request{format, Operation::release, ticket, static_cast<std::uint32_t>(handles.size()),
                  ""};
  Writer out(request);
  for (const std::uint32_t handle : handles) out.put(handle);
  request.text = format == Format::lines
                     ? request_line(request, Json(std::vector(handles.begin(), handles.end())))
                     : out.take();
  return request;
}

std::size_t Request::answer_size() const {
  if (format == Format::lines) return 0;
  switch (operation) {
    case Operation::prepare:
      return header_size + (has_roundings ? 20 : 4) * std::size_t{count};
    case Operation::query:
      return header_size + answer_bytes * std::size_t{count};
    case Operation::time:
      return header_size + 8;
    case Operation::cast:
      return header_size + cast_bytes * std::size_t{count};
    case Operation::release:
      break;
  }
  return header_size;
}

std::optional<Prepared> read_prepared(const Request& request, const std::string& answer) {
  Prepared prepared{};
  if (request.format == Format::frames) {
    Reader in(request, answer);
    const auto supported = in.get<std::uint32_t>();
    if (supported > 1) refuse("it prepared with " + std::to_string(supported));
    for (double& x : prepared.roundings) x = request.has_roundings ? in.get<double>() : 0;
    return supported == 1 ? std::optional(prepared) : std::nullopt;
  }
  const Json line = answer_line(request, answer);
  const Json supported = list_member(line, "supported", 1)[0];
  if (!supported.is_boolean()) refuse("its \"supported\" has what is neither true nor false");
  if (!supported.get<bool>()) return std::nullopt;
  if (!request.has_roundings) return prepared;
  const Json both = list_member(line, "roundings", 1)[0];
  if (!both.is_array() || both.size() != 2) refuse("its \"roundings\" are no pair of numbers");
  for (std::size_t i = 0; i < 2; ++i) prepared.roundings[i] = number_of(both[i], "roundings");
  return prepared;
}

Answer read_answer(const Request& request, const std::string& answer) {
  if (request.format == Format::lines) {
    return get_answer(list_member(answer_line(request, answer), "answers", 1)[0]);
  }
  Reader in(request, answer);
  return get_answer(in);
}

std::optional<ts_cast> read_cast(const Request& request, const std::string& answer) {
  constexpr const char* names[] = {"touch", "never", "unsupported", "failed"};
  constexpr std::uint32_t failed = 3;
  std::uint32_t status = 0;
  ts_cast cast{};
  if (request.format == Format::frames) {
    Reader in(request, answer);
    status = in.get<std::uint32_t>();
    in.get<std::uint32_t>();
    cast.fraction = in.get<double>();
    for (double& x : cast.normal) x = in.get<double>();
    if (status > failed) refuse("a cast has the status " + std::to_string(status));
  } else {
    const Json json = list_member(answer_line(request, answer), "casts", 1)[0];
    if (!json.is_object()) refuse("a cast is no JSON object");
    const Json said = json.value("status", Json());
    while (status <= failed && said != names[status]) ++status;
    if (status > failed) refuse("a cast has the status " + quoted(said.dump(-1, ' ', true)));
    if (status == TS_CAST_TOUCH) {
      cast.fraction = number_of(json.value("fraction", Json()), "fraction");
      get_vector(json, "normal", cast.normal);
    }
  }
  if (status == failed) return std::nullopt;
  cast.status = static_cast<ts_cast_status>(status);
  return cast;
}

double read_time(const Request& request, const std::string& answer) {
  const double nanoseconds =
      request.format == Format::frames
          ? Reader(request, answer).get<double>()
          : number_of(answer_line(request, answer).value("nanoseconds", Json()), "nanoseconds");
  if (!std::isfinite(nanoseconds) || nanoseconds < 0) {
    refuse("its time is " + std::to_string(nanoseconds) + " ns");
  }
  return nanoseconds;
}

void read_released(const Request& request, const std::string& answer) {
  if (request.format == Format::frames) {
    Reader(request, answer);
  } else {
    answer_line(request, answer);
  }
}

}  // namespace touchstone::messages
