#ifndef OBSCURA_SETTINGS_H_
#define OBSCURA_SETTINGS_H_

#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>

#include "obscura/status.h"

// One table of settings. Each settings struct has, right below it, a function
// `visit_fields(settings, visitor)` that names every field with its unit, range and meaning. The
// defaults are the struct's own initialisers. Validation, the command line's options and help, and
// docs/settings.md are all made from these functions.

namespace obscura {

struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_excluded = false;
  bool max_excluded = false;

  bool contains(double v) const {
    return (min_excluded ? v > min : v >= min) && (max_excluded ? v < max : v <= max);
  }
};

constexpr Range closed(double min, double max) { return {min, max, false, false}; }
constexpr Range at_least(double min) {
  return {min, std::numeric_limits<double>::infinity(), false, true};
}
constexpr Range positive() { return {0, std::numeric_limits<double>::infinity(), true, true}; }
constexpr Range positive_or_infinite() {
  return {0, std::numeric_limits<double>::infinity(), true, false};
}
// Any float or integer; NaN is in no range.
constexpr Range anything() { return {}; }

struct Field {
  const char* name;  // C++ name; the command line writes '-' for '_'
  const char* unit;  // "" where there is none
  Range range;       // numbers only
  const char* help;  // one sentence
};

// Names of an enumeration's values, in order from 0. Specialised beside each enumeration.
template <class E>
struct EnumNames;  // static constexpr const char* names[]

template <class E>
std::span<const char* const> enum_names() {
  return EnumNames<E>::names;
}
template <class E>
const char* enum_name(E value) {
  return EnumNames<E>::names[static_cast<int>(value)];
}

// Used in the constraints of visit_fields, which takes its struct const or not.
template <class Self, class Struct>
concept FieldsOf = std::is_same_v<std::remove_const_t<Self>, Struct>;

// "(0, inf)", "[1, 32]": the form in which ranges stand in messages, help and docs.
std::string to_string(const Range& range);

// The sentence for a value out of range: "samples is 0; it must be in [1, 32]".
Status out_of_range(const Field& field, double value);

// Checks every number of a settings struct against its range.
template <class Settings>
Status validate_ranges(const Settings& settings) {
  Status status;
  visit_fields(settings, [&](const auto& value, const Field& field) {
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (status.ok() && !field.range.contains(static_cast<double>(value))) {
        status = out_of_range(field, static_cast<double>(value));
      }
    }
  });
  return status;
}

}  // namespace obscura

#endif  // OBSCURA_SETTINGS_H_
