// The XML of robot and world files before their libraries read it: urdfdom passes over a shape that
// it cannot read, and libsdformat puts a default in place of a length that is missing or misspelt.
#include <algorithm>
#include <boost/property_tree/xml_parser.hpp>
#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "candidates/readable.hpp"
#include "properties/files/disk.hpp"
#include "properties/files/given_text.hpp"
#include "reference/invalid_input.hpp"
#include "simulation/scenes/robot_readers.hpp"

namespace touchstone {
namespace {

using boost::property_tree::ptree;

/// Where the tag that begins there ends, whatever stands in quotes.
std::size_t end_of_tag(std::string_view xml, std::size_t at) {
  at = xml.find_first_of(">\"'", at);
  while (at != xml.npos && xml[at] != '>') {
    at = xml.find(xml[at], at + 1);
    if (at != xml.npos) at = xml.find_first_of(">\"'", at + 1);
  }
  return at;
}

/// Depth of nesting of the elements; an element that is never closed counts as open.
std::size_t depth_of(std::string_view xml) {
  std::size_t depth = 0, max_depth = 0;
  for (std::size_t at = xml.find('<'); at != xml.npos; at = xml.find('<', at + 1)) {
    const std::string_view tag = xml.substr(at);
    if (tag.starts_with("<!--")) {
      at = std::min(xml.find("-->", at), xml.size());
    } else if (tag.starts_with("</")) {
      depth -= depth > 0 ? 1 : 0;
    } else if (!tag.starts_with("<!") && !tag.starts_with("<?")) {
      max_depth = std::max(max_depth, ++depth);
      const std::size_t end = end_of_tag(xml, at);
      if (end != xml.npos && xml[end - 1] == '/') --depth;
    }
  }
  return max_depth;
}

/// A shape's name and its lengths: attributes in URDF, elements in SDF.
struct Field {
  std::string_view name;
  int count;  ///< of numbers; 0: any text
  bool is_required = true;
};
struct ShapeForm {
  std::string_view name;
  std::vector<Field> fields;
  bool is_read = true;  ///< or ignored, with a note, as height fields are
};

const std::vector<ShapeForm> urdf_shapes = {{"sphere", {{"radius", 1}}},
                                            {"cylinder", {{"radius", 1}, {"length", 1}}},
                                            {"box", {{"size", 3}}},
                                            {"mesh", {{"filename", 0}, {"scale", 3, false}}}};
const std::vector<ShapeForm> sdf_shapes = {
    {"sphere", {{"radius", 1}}},
    {"cylinder", {{"radius", 1}, {"length", 1}}},
    {"capsule", {{"radius", 1}, {"length", 1}}},
    {"box", {{"size", 3}}},
    {"plane", {{"normal", 3}, {"size", 2, false}}},
    {"ellipsoid", {}, false},
    {"mesh", {{"uri", 0}, {"scale", 3, false}, {"submesh", 0, false}}},
    {"heightmap", {}, false},
    {"image", {}, false},
    {"polyline", {}, false},
    {"empty", {}, false}};

constexpr std::size_t max_shown_bytes = 60;
std::string shown_text(std::string_view text) {
  return '"' + printable(text, max_shown_bytes) + '"';
}

template <class List>
std::string names_of(const List& list) {
  std::string names;
  for (const auto& entry : list) {
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  return names;
}

/// Number of decimal numbers between spaces; none if anything else is among them.
std::optional<int> count_of_numbers(const std::string& text) {
  std::istringstream words(text);
  int count = 0;
  for (std::string word; words >> word; ++count) {
    const bool is_hexadecimal = word.find_first_of("xX") != word.npos;  // unknown to the libraries
    const std::string_view digits = std::string_view(word).substr(word[0] == '+' ? 1 : 0);
    if (is_hexadecimal || !parse_double(digits)) return {};
  }
  return count;
}

/// Throws InvalidInput unless the text is so many numbers.
void check_numbers(const std::string& text, int count, const std::string& field) {
  if (count_of_numbers(text) == count) return;
  throw InvalidInput(field, shown_text(text),
                     count == 1 ? "must be a number, with a decimal point and without a unit"
                                : fmt::format("must be {} numbers between spaces", count));
}

bool is_meta(std::string_view name) { return name.starts_with('<'); }  // attributes, comments

/// Checks the fields of a shape that is read; those are its attributes or its elements.
void check_fields(const ptree& fields, const ShapeForm& form, const std::string& where) {
  for (const auto& entry : fields) {
    const std::string& name = entry.first;
    const bool is_foreign = name.find(':') != name.npos;  // of a name space, an extension
    const auto is_it = [&](const Field& f) { return f.name == name; };
    if (is_meta(name) || is_foreign || std::ranges::any_of(form.fields, is_it)) continue;
    throw InvalidInput(where + '.' + printable(name, max_shown_bytes), "unknown",
                       "must be one of " + names_of(form.fields));
  }
  for (const Field& field : form.fields) {
    const std::string name(field.name), path = where + '.' + name;
    const std::size_t given = fields.count(name);
    if (given == 0 && !field.is_required) continue;
    if (given != 1) {
      throw InvalidInput(path, given == 0 ? "missing" : "there more than once",
                         "must be there once");
    }
    if (field.count > 0) check_numbers(fields.get<std::string>(name), field.count, path);
  }
}

/// Checks a collision element, of which `where` is the name in messages.
void check_collision(const ptree& collision, const std::vector<ShapeForm>& forms,
                     bool has_attributes, const std::string& where) {
  const auto geometry = collision.get_child_optional("geometry");
  if (!geometry) {
    throw InvalidInput(where + ".geometry", "missing", "must hold one of " + names_of(forms));
  }
  int count = 0;
  for (const auto& entry : *geometry) {
    const std::string& name = entry.first;
    const ptree& content = entry.second;
    if (is_meta(name)) continue;
    ++count;
    const auto is_it = [&](const ShapeForm& f) { return f.name == name; };
    const auto form = std::ranges::find_if(forms, is_it);
    if (form == forms.end()) {
      throw InvalidInput(where + ".geometry", shown_text(name),
                         "must hold one of " + names_of(forms));
    }
    if (!form->is_read) continue;
    const ptree none;
    check_fields(has_attributes ? content.get_child("<xmlattr>", none) : content, *form,
                 where + '.' + name);
  }
  if (count != 1 || collision.count("geometry") != 1) {
    throw InvalidInput(where + ".geometry", count == 0 ? "empty" : "more than one shape",
                       "must hold one of " + names_of(forms));
  }
}

std::string name_of(const ptree& element) {
  return printable(element.get<std::string>("<xmlattr>.name", ""), max_shown_bytes);
}

/// Checks a pose as far as its reader does not, which knows how many numbers it must have.
void check_sdf_pose(const ptree& element, const std::string& where) {
  const std::string text = element.get<std::string>("pose", "");
  if (count_of_numbers(text)) return;
  throw InvalidInput(where + ".pose", shown_text(text),
                     "must be numbers between spaces, without units");
}

/// Checks the numbers of the inertials, in which libsdformat passes over a unit.
void check_sdf_inertial(const ptree& link, const std::string& where) {
  for (const auto& [tag, inertial] : link) {
    if (tag != "inertial") continue;
    check_sdf_pose(inertial, where);
    for (const auto& [name, number] : inertial) {
      if (name == "mass") check_numbers(number.data(), 1, where + '.' + name);
      if (name != "inertia") continue;
      for (const auto& [moment, value] : number) {
        if (!is_meta(moment)) check_numbers(value.data(), 1, where + ".inertia." + moment);
      }
    }
  }
}

/// Checks a number at a path of elements, if it is there.
void check_sdf_number(const ptree& element, const char* path, const std::string& where) {
  const auto text = element.get_optional<std::string>(path);
  const bool is_limitless = text && (*text == "inf" || *text == "+inf" || *text == "-inf");
  if (text && !is_limitless) check_numbers(*text, 1, where + '.' + path);
}

/// Checks what is read of a joint.
void check_sdf_joint(const ptree& joint, const std::string& where) {
  check_sdf_pose(joint, where);
  for (const char* number : {"axis.limit.lower", "axis.limit.upper", "axis.limit.effort"}) {
    check_sdf_number(joint, number, where);
  }
}

/// Checks the inertials, collisions and joints, at any depth; `path` names the models around them.
/// Where it is not a shape's, libsdformat takes a number up to its unit.
void check_sdf_links(const ptree& element, const std::string& path) {
  for (const auto& [tag, content] : element) {
    const std::string name = path + name_of(content);
    if (tag == "world") {
      const auto gravity = content.get_optional<std::string>("gravity");
      if (gravity) check_numbers(*gravity, 3, "world " + name + ".gravity");
      check_sdf_links(content, path);
    }
    const bool has_pose = tag == "model" || tag == "link" || tag == "frame" || tag == "include";
    if (has_pose) check_sdf_pose(content, tag + ' ' + name);
    if (tag == "joint") check_sdf_joint(content, "joint " + name);
    if (tag == "model") check_sdf_links(content, name + "::");
    if (tag != "link") continue;
    check_sdf_inertial(content, "link " + name + ".inertial");
    for (const auto& [child, collision] : content) {
      if (child != "collision") continue;
      const std::string where = "collision " + name + '/' + name_of(collision);
      check_sdf_pose(collision, where);
      check_collision(collision, sdf_shapes, false, where);
      check_sdf_number(collision, "surface.friction.ode.mu", where);
    }
  }
}

}  // namespace

std::map<std::string, std::size_t> check_urdf_collisions(const ptree& tree) {
  std::map<std::string, std::size_t> counts;
  const ptree none;
  for (const auto& [tag, link] : tree.get_child("robot", none)) {
    if (tag != "link") continue;
    const std::string name = link.get<std::string>("<xmlattr>.name", "");
    std::size_t& count = counts[name];
    for (const auto& [child, collision] : link) {
      if (child != "collision") continue;
      const std::string own = name_of(collision);
      const std::string where = "collision " + printable(name, max_shown_bytes) + '/' +
                                (own.empty() ? std::to_string(count + 1) : own);
      check_collision(collision, urdf_shapes, true, where);
      ++count;
    }
  }
  return counts;
}

void check_sdf_collisions(const ptree& tree, std::string_view newest_version) {
  const ptree none;
  const ptree& sdf = tree.get_child("sdf", none);
  const std::string version = sdf.get<std::string>("<xmlattr>.version", "");
  const auto major_and_minor = [](std::string_view number) {
    const std::size_t dot = std::min(number.find('.'), number.size());
    const auto minor = parse_double(number.substr(std::min(dot + 1, number.size())));
    return std::pair(parse_double(number.substr(0, dot)), minor);
  };
  const auto [major, minor] = major_and_minor(version);
  const auto [newest_major, newest_minor] = major_and_minor(newest_version);
  if (major != newest_major || !minor || minor > newest_minor) {
    throw InvalidInput("sdf.version", shown_text(version),
                       fmt::format("must be 1.0 to {}", newest_version));
  }
  check_sdf_links(sdf, "");
}

namespace {

/// Refuses other encodings: names go into JSON, and the file's readers do not convert them.
void check_utf8(const std::string& text, const std::filesystem::path& file) {
  const std::string good = readable(text);
  for (std::size_t i = 0, line = 1; i < text.size(); ++i) {
    if (text[i] == '\n') ++line;
    const bool is_ascii = static_cast<unsigned char>(text[i]) < 0x80;
    if (is_ascii || good[i] != '?') continue;
    throw InvalidInput("scene", '"' + file.string() + '"',
                       fmt::format("must be UTF-8, whatever it says itself: line {} is not", line));
  }
}

}  // namespace

ptree parse_xml(const std::string& text, const std::filesystem::path& file) {
  std::istringstream in(text);
  ptree tree;
  try {
    boost::property_tree::read_xml(in, tree);
  } catch (const boost::property_tree::xml_parser_error& e) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       fmt::format("must be XML: {} at line {}", e.message(), e.line()));
  }
  return tree;
}

std::string read_xml(const std::filesystem::path& file) {
  std::string text = read_file(file, "scene");
  constexpr std::size_t max_depth = 100;
  if (text.find('\0') != text.npos) {
    throw InvalidInput("scene", '"' + file.string() + '"', "must be text: it holds a NUL byte");
  }
  if (depth_of(text) > max_depth) {
    throw InvalidInput("scene", '"' + file.string() + '"',
                       fmt::format("must have elements at most {} levels deep", max_depth));
  }
  check_utf8(text, file);
  return text;
}

}  // namespace touchstone
