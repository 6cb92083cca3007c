#ifndef OBSCURA_SETTINGS_H_
#define OBSCURA_SETTINGS_H_

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "obscura/export.h"
#include "obscura/status.h"

// One table of settings. Each settings struct has, right below it, a function
// `visit_fields(settings, visitor)` that names every field with its unit, range and meaning: they
// stand there and nowhere else. The defaults are the struct's own initialisers. Validation, the
// command line's options and help, and docs/settings.md are all made from these functions. The
// struct itself has comments on fields that no table can list only, such as callables.

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

// What of a range fits an integer type.
template <class T>
Range integer_range(Range range) {
  const auto lowest = static_cast<double>(std::numeric_limits<T>::min());
  const auto highest = static_cast<double>(std::numeric_limits<T>::max());
  if (!(range.min >= lowest)) range = {lowest, range.max, false, range.max_excluded};
  if (!(range.max <= highest)) range = {range.min, highest, range.min_excluded, false};
  return range;
}

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
// How many values an enumeration has, where more than text can name.
template <class E>
inline constexpr int kEnumCount = static_cast<int>(std::size(EnumNames<E>::names));
template <class E>
bool is_valid_enum(E value) {
  return static_cast<int>(value) >= 0 && static_cast<int>(value) < kEnumCount<E>;
}
template <class E>
const char* enum_name(E value) {
  return EnumNames<E>::names[static_cast<int>(value)];
}

// What is said of a method. Specialised beside each method's settings, with
//   static constexpr const char* name;     as the command line knows it: "far-field"
//   static constexpr const char* summary;  one line, without a full stop
//   static constexpr const char* page;     of the documentation: "docs/methods/far-field.md"
//   static constexpr bool on_vulkan;       whether vulkan::Recorder takes it
//   static constexpr bool takes_layers;    of those with an occluder that take depth layers: true
template <class Settings>
struct MethodInfo;

// How a field's type that is neither number, flag nor enumeration is written as text. Specialised
// beside each such type with `form` (its grammar, for help: text or a function that gives it),
// `parse` (true on success) and `write`.
template <class T>
struct SettingText;

// Used in the constraints of visit_fields, which takes its struct const or not.
template <class Self, class Struct>
concept FieldsOf = std::is_same_v<std::remove_const_t<Self>, Struct>;

// "(0, inf)", "[1, 32]": the form in which ranges stand in messages, help and docs.
OBSCURA_API std::string to_string(const Range& range);

// The sentence for a value out of range: "samples is 0; it must be in [1, 32]".
OBSCURA_API Status out_of_range(const Field& field, double value);

// Parts of parse_setting.
OBSCURA_API bool parse_number(std::string_view text, double* value);
OBSCURA_API std::string write_number(double value, bool single_precision);
OBSCURA_API Status bad_setting(std::string_view name, std::string_view text,
                               std::string_view expected);
OBSCURA_API std::string one_of(std::span<const char* const> names);

// What a value of type T may be, for help and messages: "a number in (0, inf)", "one of a, b".
template <class T>
std::string expected_text(const Field& field) {
  if constexpr (std::is_same_v<T, bool>) {
    return "true or false";
  } else if constexpr (std::is_enum_v<T>) {
    return one_of(enum_names<T>());
  } else if constexpr (std::is_integral_v<T>) {
    return "a whole number in " + to_string(integer_range<T>(field.range));
  } else if constexpr (std::is_floating_point_v<T>) {
    return "a number in " + to_string(field.range);
  } else if constexpr (requires { SettingText<T>::form(); }) {
    return SettingText<T>::form();
  } else {
    return SettingText<T>::form;
  }
}

// Reads a value from text; on failure says what `name`, as the user knows it, may be.
template <class T>
Status parse_setting(std::string_view name, const Field& field, std::string_view text, T* value) {
  bool good = false;
  if constexpr (std::is_same_v<T, bool>) {
    good = text == "true" || text == "false";
    if (good) *value = text == "true";
  } else if constexpr (std::is_enum_v<T>) {
    const auto names = enum_names<T>();
    for (std::size_t i = 0; i < names.size() && !good; ++i) {
      good = text == names[i];
      if (good) *value = static_cast<T>(i);
    }
  } else if constexpr (std::is_arithmetic_v<T>) {
    double number;
    const Range range = std::is_integral_v<T> ? integer_range<T>(field.range) : field.range;
    good = parse_number(text, &number) && range.contains(number) &&
           (!std::is_integral_v<T> || number == std::floor(number));
    // A number that rounds out of its range in T (1e-60 to 0, 1e60 to inf) is out of range too.
    good = good && range.contains(static_cast<double>(static_cast<T>(number)));
    if (good) *value = static_cast<T>(number);
  } else {
    good = SettingText<T>::parse(text, value);
  }
  return good ? Status() : bad_setting(name, text, expected_text<T>(field));
}

// The text that parse_setting would read back.
template <class T>
std::string write_setting(const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    return value ? "true" : "false";
  } else if constexpr (std::is_enum_v<T>) {
    return enum_name(value);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return write_number(static_cast<double>(value), std::is_same_v<T, float>);
  } else {
    return SettingText<T>::write(value);
  }
}

// The sentence for an enumeration's value that does not exist.
template <class E>
Status no_such_value(const char* name, E value) {
  return invalid_argument(std::string(name) + " is " + std::to_string(static_cast<int>(value)) +
                          "; it must be " + one_of(enum_names<E>()));
}

// Checks every number of a settings struct against its range, and every enumeration.
template <class Settings>
Status validate_ranges(const Settings& settings) {
  Status status;
  visit_fields(settings, [&](const auto& value, const Field& field) {
    using T = std::remove_cvref_t<decltype(value)>;
    if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) {
      if (status.ok() && !field.range.contains(static_cast<double>(value))) {
        status = out_of_range(field, static_cast<double>(value));
      }
    } else if constexpr (std::is_enum_v<T>) {
      if (status.ok() && !is_valid_enum(value)) status = no_such_value(field.name, value);
    }
  });
  return status;
}

}  // namespace obscura

#endif  // OBSCURA_SETTINGS_H_
