#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace touchstone {

/// A text as the value of InvalidInput.
inline std::string in_quotes(std::string_view text) { return '"' + std::string(text) + '"'; }

/// What a person gave cannot be used. Thrown at the border only (construction of shapes and poses,
/// files, command line); `what()` reads "radius is -1: must be positive and finite".
class InvalidInput : public std::invalid_argument {
 public:
  /// `field` is the name the person wrote ("radius", "pose_b.orientation"), `value` what stood
  /// there, `remedy` what would be right.
  InvalidInput(std::string field, std::string value, std::string remedy)
      : std::invalid_argument(field + " is " + value + ": " + remedy),
        field_(std::move(field)),
        value_(std::move(value)),
        remedy_(std::move(remedy)) {}

  const std::string& field() const { return field_; }
  const std::string& value() const { return value_; }
  const std::string& remedy() const { return remedy_; }

  /// The same error, seen from one level further out: field "a" makes "radius" into "a.radius".
  InvalidInput within(const std::string& outer) const {
    return InvalidInput(outer + "." + field_, value_, remedy_);
  }

 private:
  std::string field_;
  std::string value_;
  std::string remedy_;
};

}  // namespace touchstone
