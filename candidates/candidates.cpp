#include "candidates/candidates.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <deque>
#include <dlfcn.h>
#include <fstream>
#include <system_error>

#include "candidates/host/plugin_process.hpp"
#include "candidates/npm_engines.hpp"
#include "reference/invalid_input.hpp"

namespace touchstone {
namespace {

/// In report order, with the Debian package of the engine; empty: always built.
constexpr struct {
  const char* name;
  const char* package;
} standard_plugins[] = {
    {"reference", ""},           {"bullet", "libbullet-dev"}, {"bullet-float", "libbullet-dev"},
    {"ode", "libode-dev"},       {"fcl", "libfcl-dev"},       {"libccd", "libccd-dev"},
    {"mujoco", "libmujoco-dev"}, {"simplified", ""},          {"box-parts", ""}};

/// Candidates that are part of a report only if they are named, like engines from npm, and nothing
/// is loaded before: our routines in single precision, engines whose cylinders are Touchstone's
/// (reference/engines), and floors of triangles (floor.hpp); and peers, engines that Debian does
/// not have, which are built where CMake finds them, so that a default report is the same
/// everywhere.
constexpr struct {
  const char* name;
  const char* plugin;
  bool is_peer;
} plugins_to_name[] = {{"reference-float", "reference-float", false},
                       {"bullet+touchstone", "bullet+touchstone", false},
                       {"bullet-float+touchstone", "bullet-float+touchstone", false},
                       {"ode+touchstone", "ode+touchstone", false},
                       {"mujoco+touchstone", "mujoco+touchstone", false},
                       {"bullet-floor", "bullet-floor", false},
                       {"bullet-floor-edges", "bullet-floor", false},
                       {"bullet-heights", "bullet-floor", false},
                       {"bullet-heights-edges", "bullet-floor", false},
                       {"ode-floor", "ode-floor", false},
                       {"ode-heights", "ode-floor", false},
                       {"fcl-floor", "fcl-floor", false},
                       {"mujoco-heights", "mujoco-floor", false},
                       {"coal", "coal", true},
                       {"coal-patch", "coal", true},
                       {"jolt-native", "jolt-native", true},
                       {"jolt-native-margin-0", "jolt-native", true},
                       {"box3d", "box3d", true}};

/// Families of the standard plug-ins that are asked once they are named, or with --all-candidates:
/// other settings, calls and models of what is asked anyway, which take a third of a report's time.
constexpr std::string_view variants[] = {
    "bullet-persistent", "bullet-hull", "bullet-float-margin-0", "ode-mesh",    "fcl-indep",
    "fcl-distance",      "libccd-gjk",  "box-spheres",           "box-capsules"};

/// The folder of this code's file: of the program or, in Python, of the module.
std::filesystem::path own_folder() {
  static const char here = 0;
  Dl_info of_here;
  // Of a program, the name may be the one that it was started by, without its folder.
  if (dladdr(&here, &of_here) != 0) {
    const std::filesystem::path file = of_here.dli_fname;
    if (file.extension() == ".so") return std::filesystem::canonical(file).parent_path();
  }
  return std::filesystem::read_symlink("/proc/self/exe").parent_path();
}

}  // namespace

// Tests and the Python module lie two folders deep.
std::filesystem::path standard_folder() {
  auto own = own_folder();
  for (const char* folder : {"candidates", "../candidates", "../../candidates", "../lib/touchstone",
                             "../../../touchstone"}) {
    const auto path = own / folder;
    if (std::filesystem::exists(path / "touchstone-reference.so")) return path.lexically_normal();
  }
  return own;
}

bool is_in_clone() {
  std::error_code none;
  return std::filesystem::is_regular_file(standard_folder() / "../../../touchstone", none);
}

namespace {

std::filesystem::path standard_file(std::string_view name) {
  return standard_folder() / ("touchstone-" + std::string(name) + ".so");
}

/// The shortest text that reads back as the same double.
std::string number(double value) {
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::optional<double> to_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The plug-in of a family that is loaded once it is named; absent if it was not built.
std::optional<std::filesystem::path> plugin_to_name(std::string_view family) {
  for (const auto& [name, plugin, is_peer] : plugins_to_name) {
    if (family == name && std::filesystem::exists(standard_file(plugin))) {
      return standard_file(plugin);
    }
  }
  return std::nullopt;
}

std::vector<std::string> built_to_name(bool peers) {
  std::vector<std::string> names;
  for (const auto& [name, plugin, is_peer] : plugins_to_name) {
    if (is_peer == peers && plugin_to_name(name)) names.emplace_back(name);
  }
  return names;
}

/// A name's parts. The release of an engine from npm belongs to the family, whose parameter stands
/// before it: "jolt-margin:0.01@0.30" is of the family "jolt-margin@0.30".
struct NameParts {
  std::string family;
  std::optional<std::string> parameter;
};
NameParts parts_of(std::string_view name) {
  const auto colon = name.find(':');
  NameParts parts{std::string(name.substr(0, colon)), std::nullopt};
  if (colon == name.npos) return parts;
  const std::string_view rest = name.substr(colon + 1);
  const auto at = rest.find('@');
  parts.parameter = rest.substr(0, at);
  if (at != rest.npos) parts.family += rest.substr(at);
  return parts;
}

Candidate member(const Candidate& family, double value) {
  Candidate c = family;
  const bool bare = family.parameter->bare && value == family.parameter->usual;
  const std::size_t release = npm_release(family.family).size();
  const std::size_t end = family.family.size() - (release > 0 ? release + 1 : 0);
  if (!bare)
    c.name = family.family.substr(0, end) + ':' + number(value) + family.family.substr(end);
  c.value = value;
  return c;
}

class Registry {
 public:
  static Registry& get() {
    static Registry registry;
    return registry;
  }

  /// `by`: what brings the plug-in; absent for a standard one.
  void add_plugin(const std::filesystem::path& file, const std::optional<Added>& by) {
    add(PluginProcess(file).candidates(), {"--load", file.string()}, by, true);
  }

  /// `subject`: the option and value that are to blame.
  void add_command(const std::string& command, const std::filesystem::path& folder,
                   const Added& subject, const Added& by) {
    add({told_by(command, folder, subject)}, subject, by, true);
  }

  const std::vector<const Candidate*>& listed() const { return listed_; }
  const std::vector<Skipped>& skipped() const { return skipped_; }
  std::vector<Added> added;

  const Candidate* known(std::string_view name) const {
    for (const Candidate& c : known_) {
      if (c.name == name) return &c;
    }
    return nullptr;
  }

  const Candidate& find(std::string_view name) {
    if (const Candidate* const c = known(name)) return *c;
    const auto [family, parameter] = parts_of(name);
    for (const Candidate& c : known_) {
      if (c.family == family) return parameter ? find_member(c, name, *parameter) : c;
    }
    if (const auto file = plugin_to_name(family)) {
      add(PluginProcess(*file).candidates(), {"--candidates", family}, std::nullopt, false);
      return find(name);
    }
    if (const NpmEngine* const engine = find_npm_engine(family)) {
      add_npm_engine(*engine, family, name);
      return find(name);
    }
    if (name.find('/') != std::string_view::npos || name.ends_with(".so")) {
      throw InvalidInput("--candidates", in_quotes(name),
                         "must be a name; a plug-in's file is given by --load");
    }
    for (const Skipped& s : skipped_) {
      if (family != s.name && !family.starts_with(s.name + '-')) continue;
      throw InvalidInput("--candidates", in_quotes(name),
                         "is unavailable; " + s.name + ": skipped; " + s.reason);
    }
    std::string names;
    for (const Candidate* c : listed_) names += (names.empty() ? "" : ", ") + c->name;
    const auto is_listed = [&](std::string_view other) {
      const auto is = [&](const Candidate* c) { return c->family == other; };
      return std::any_of(listed_.begin(), listed_.end(), is);
    };
    for (const auto& to_name : {named_candidates(), peer_engines()}) {
      for (const std::string& other : to_name) {
        if (!is_listed(other)) names += ", " + other;
      }
    }
    for (const NpmEngine& engine : npm_engines()) {
      // A command of one's own may have taken the name.
      if (!is_listed(engine.family)) names += ", " + std::string(engine.family);
    }
    throw InvalidInput("--candidates", in_quotes(name), "must be one of " + names);
  }

 private:
  /// The candidate that the command says it is.
  static Candidate told_by(const std::string& command, const std::filesystem::path& folder,
                           const Added& subject) {
    try {
      return PluginProcess(Candidate::Command{command, folder, false}).candidates().front();
    } catch (const NoHost&) {
      throw;
    } catch (const InvalidInput& e) {
      throw InvalidInput(subject.option, in_quotes(subject.value), e.remedy());
    }
  }

  /// What the engine's adapter says that it is. An old release may lack what the adapter calls.
  static Candidate npm_candidate(const NpmEngine& engine, std::string_view release,
                                 const Added& subject) {
    try {
      return told_by(npm_command(engine, release), npm_folder(), subject);
    } catch (const NoHost&) {
      throw;
    } catch (const InvalidInput& e) {
      const auto reason = e.remedy().find("unsupported: ");
      if (reason == std::string::npos) throw;
      throw InvalidInput(subject.option, in_quotes(subject.value),
                         "is " + e.remedy().substr(reason));
    }
  }

  /// Engines from npm are known once they are named, and in no list before or after.
  void add_npm_engine(const NpmEngine& engine, const std::string& family, std::string_view name) {
    const Added subject{"--candidates", std::string(name)};
    const std::string_view release = npm_release(family);
    constexpr const char* in_release =
        "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ.-+";
    if (family.ends_with('@') || release.find_first_not_of(in_release) != release.npos) {
      throw InvalidInput(subject.option, in_quotes(subject.value),
                         "must be \"" + std::string(engine.family) +
                             "@\" and a release or its beginning, as 1.0.2 or 1.0");
    }
    if (const std::string obstacle = npm_obstacle(engine, release); !obstacle.empty()) {
      throw InvalidInput(subject.option, in_quotes(subject.value), "is unavailable: " + obstacle);
    }
    const Candidate candidate = npm_candidate(engine, release, subject);
    if (candidate.family != family) {
      throw InvalidInput(subject.option, in_quotes(subject.value),
                         "is unavailable: its adapter says that it is " + candidate.family);
    }
    add({candidate}, subject, {}, false);
  }

  void add(std::vector<Candidate> candidates, const Added& subject, const std::optional<Added>& by,
           bool listed) {
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const Candidate& c = candidates[i];
      const auto same = [&](const Candidate& other) { return other.family == c.family; };
      if (std::any_of(known_.begin(), known_.end(), same) ||
          std::any_of(candidates.begin(), candidates.begin() + static_cast<std::ptrdiff_t>(i),
                      same)) {
        throw InvalidInput(subject.option, in_quotes(subject.value),
                           "must not bring \"" + c.family + "\", a name that is taken");
      }
    }
    for (Candidate& c : candidates) {
      c.added = by;
      known_.push_back(c.parameter ? member(c, c.parameter->usual) : c);
      if (listed) listed_.push_back(&known_.back());
    }
  }

  Registry() {
    for (const auto& [name, package] : standard_plugins) {
      const auto file = standard_file(name);
      if (!std::filesystem::exists(file)) {
        skipped_.push_back(
            {name, std::string("was not built; install Debian's ") + package + " and build again"});
        continue;
      }
      try {
        add_plugin(file, {});
      } catch (const NoHost&) {
        throw;
      } catch (const InvalidInput& e) {
        skipped_.push_back({name, e.what()});
      }
    }
  }

  const Candidate& find_member(const Candidate& family, std::string_view name,
                               std::string_view parameter) {
    const auto& p = family.parameter;
    const std::optional<double> value = to_number(parameter);
    if (!p) {
      throw InvalidInput("--candidates", in_quotes(name),
                         "must be \"" + family.family + "\", which takes no number");
    }
    if (!value || !(*value >= p->min && *value <= p->max) ||
        (p->whole && *value != std::floor(*value))) {
      throw InvalidInput("--candidates", in_quotes(name),
                         "must be \"" + family.family + ":\" and the " + p->meaning + ", " +
                             (p->whole ? "a whole number" : "a number") + " from " +
                             number(p->min) + " to " + number(p->max));
    }
    const Candidate c = member(family, *value);
    for (const Candidate& k : known_) {
      if (k.name == c.name) return k;
    }
    return known_.emplace_back(c);
  }

  std::deque<Candidate> known_;  // a deque, so that references stay valid
  std::vector<const Candidate*> listed_;
  std::vector<Skipped> skipped_;
};

struct ToTsShape {
  ts_shape operator()(const Cylinder& s) const {
    return rounded(sized(TS_CYLINDER, s.radius(), s.half_length()), s.rounding());
  }
  ts_shape operator()(const Plane& s) const {
    const Vec3& n = s.unit_normal();
    return sized(TS_PLANE, n.x(), n.y(), n.z(), s.unit_displacement());
  }
  ts_shape operator()(const Sphere& s) const { return sized(TS_SPHERE, s.radius()); }
  ts_shape operator()(const Capsule& s) const {
    return sized(TS_CAPSULE, s.radius(), s.half_length());
  }
  ts_shape operator()(const Box& s) const {
    const Vec3& h = s.half_extents();
    return rounded(sized(TS_BOX, h.x(), h.y(), h.z()), s.rounding());
  }
  ts_shape operator()(const Convex& s) const {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    ts_shape shape = sized(TS_CONVEX, 0);
    shape.vertices = s.vertices().front().data();
    shape.faces = s.face_list().data();
    shape.vertex_count = static_cast<int>(s.vertices().size());
    shape.face_count = static_cast<int>(s.faces().size());
    return rounded(shape, s.rounding());
  }
  static ts_shape rounded(ts_shape shape, double rounding) {
    shape.rounding = rounding;
    return shape;
  }
};

/// The numbers of "1..64".
std::vector<double> sweep(const Candidate& family, std::string_view text) {
  const auto dots = text.find("..");
  const auto first = to_number(text.substr(0, dots)), last = to_number(text.substr(dots + 2));
  if (!first || !last || !(*first > 0) || !(*last >= *first) || !std::isfinite(*last)) {
    throw InvalidInput("--candidates", in_quotes(family.family + ':' + std::string(text)),
                       "must be two positive numbers in rising order, as in 1..64");
  }
  const double factor = family.parameter && family.parameter->whole ? 2 : 10;
  std::vector<double> values;
  for (double power = 1; *first * power <= *last * (1 + 1e-12); power *= factor) {
    // Rounded to 15 digits, so that 1e-6 · 10 is 1e-5.
    char text_of_value[32];
    std::snprintf(text_of_value, sizeof text_of_value, "%.15g", *first * power);
    values.push_back(std::min(*to_number(text_of_value), *last));
  }
  return values;
}

}  // namespace

bool Candidate::has_routine_for(Pair pair) const {
  constexpr ts_shape_kind kinds[] = {TS_PLANE,    TS_SPHERE, TS_CAPSULE,
                                     TS_CYLINDER, TS_BOX,    TS_CONVEX};
  static_assert(std::size(kinds) == std::size(all_pairs));
  return supports[kinds[static_cast<std::size_t>(pair)]];
}

std::vector<std::string> named_candidates() { return built_to_name(false); }

std::vector<std::string> peer_engines() { return built_to_name(true); }

std::vector<const Candidate*> all_candidates() { return Registry::get().listed(); }

std::vector<const Candidate*> default_candidates() {
  std::vector<const Candidate*> result = all_candidates();
  std::erase_if(result, [](const Candidate* c) {
    return !c->added && std::ranges::find(variants, c->family) != std::end(variants);
  });
  return result;
}

const Candidate& find_candidate(std::string_view name) { return Registry::get().find(name); }

const Candidate* known_candidate(std::string_view name) { return Registry::get().known(name); }

std::string runs_as(std::string_view name) {
  const Candidate* const known = known_candidate(name);
  return known ? known->runs : "native";
}

std::vector<const Candidate*> find_candidates(const std::vector<std::string>& names) {
  std::vector<const Candidate*> result;
  std::string family;
  const auto add = [&](const Candidate& c) {
    if (std::find(result.begin(), result.end(), &c) == result.end()) result.push_back(&c);
  };
  for (const std::string& text : names) {
    // A number alone is a further member of the preceding family.
    const bool goes_on = !family.empty() && !text.empty() &&
                         (std::isdigit(static_cast<unsigned char>(text[0])) || text[0] == '.');
    const std::string name = goes_on ? family + ':' + text : text;
    const auto parts = parts_of(name);
    family = parts.parameter ? parts.family : "";
    if (parts.parameter && parts.parameter->find("..") != std::string::npos) {
      for (const double v : sweep(find_candidate(family), *parts.parameter)) {
        add(find_candidate(family + ':' + number(v)));
      }
    } else {
      add(find_candidate(name));
    }
  }
  return result;
}

namespace {

/// Adds the commands of a list.
void add_list(const std::filesystem::path& file) {
  std::ifstream lines(file);
  int number = 0, commands = 0;
  std::string line;
  for (; std::getline(lines, line); ++number) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (number == 0 && line.starts_with(byte_order_mark)) line.erase(0, byte_order_mark.size());
    const auto first = line.find_first_not_of(" \t\r");
    if (first == std::string::npos || line[first] == '#') continue;
    const std::string where = file.string() + " line " + std::to_string(number + 1);
    const std::string command = line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
    try {
      Registry::get().add_command(command, file.parent_path(), {"--load", command},
                                  {"--load", file.string()});
    } catch (const InvalidInput& e) {
      throw InvalidInput("--load", where + ": " + e.value(), e.remedy());
    }
    ++commands;
  }
  if (lines.bad()) throw InvalidInput("--load", file.string(), "must be a file that can be read");
  if (commands == 0) {
    throw InvalidInput("--load", in_quotes(file.string()),
                       "must list a command, one a line; lines that begin with # are comments");
  }
}

/// Does it begin as the shared objects of Linux do?
bool is_elf(const std::filesystem::path& file) {
  constexpr std::string_view magic =
      "\x7f"
      "ELF";
  std::string start(magic.size(), '\0');
  std::ifstream(file, std::ios::binary)
      .read(start.data(), static_cast<std::streamsize>(start.size()));
  return start == magic;
}

}  // namespace

void add_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto path = std::filesystem::canonical(file, error);
  if (error) throw InvalidInput("--load", in_quotes(file.string()), "must be a file");
  if (!std::filesystem::is_regular_file(path)) {  // opening a FIFO would wait for a writer
    throw InvalidInput("--load", in_quotes(file.string()), "must be a regular file");
  }
  const Added added{"--load", path.string()};
  if (path.extension() != ".txt" && !is_elf(path)) {
    throw InvalidInput("--load", in_quotes(file.string()),
                       "must be a plug-in, which is a shared object (.so), or a list of commands, "
                       "whose name ends in .txt");
  }
  if (path.extension() == ".txt") {
    add_list(path);
  } else {
    Registry::get().add_plugin(path, added);
  }
  Registry::get().added.push_back(added);
}

void add_command(const std::string& command, const std::filesystem::path& folder) {
  const Added added{"--candidate-command", command};
  Registry::get().add_command(command, folder, added, added);
  Registry::get().added.push_back(added);
}

const std::vector<Added>& added_candidates() { return Registry::get().added; }

const std::vector<Skipped>& skipped_plugins() { return Registry::get().skipped(); }

ts_shape to_ts_shape(const Shape& shape) { return std::visit(ToTsShape{}, shape); }

ts_pose to_ts_pose(const Pose& pose) {
  const Vec3& p = pose.position();
  const Eigen::Quaterniond q = pose.unit_orientation();
  return {{p.x(), p.y(), p.z()}, {q.w(), q.x(), q.y(), q.z()}};
}

}  // namespace touchstone
