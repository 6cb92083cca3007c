#ifndef OBSCURA_IO_REPORT_JSON_H_
#define OBSCURA_IO_REPORT_JSON_H_

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace obscura::tools {

// A member of an object. A template, so that it is complete where Json is.
template <class Value>
struct NamedValue {
  std::string name;
  Value value;
};

// A JSON value that is built and printed. Its header costs little to include; the library that
// prints it (nlohmann-json) is known to json.cpp alone.
class Json {
 public:
  using Member = NamedValue<Json>;
  using Array = std::vector<Json>;
  using Object = std::vector<Member>;  // in order of insertion

  Json() = default;  // null
  Json(bool value) : value_(value) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  Json(std::string_view text) : value_(std::string(text)) {}
  template <class T>
  requires(std::is_arithmetic_v<T> && !std::same_as<T, bool>) Json(T number) {
    if constexpr (std::is_floating_point_v<T>) {
      value_ = static_cast<double>(number);
    } else {
      value_ = static_cast<std::int64_t>(number);
    }
  }
  // An array of the elements of an std::array, std::vector or std::span.
  template <class Range>
  requires requires(const Range& r) {
    r.data() + r.size();
  } &&(!std::convertible_to<const Range&, std::string_view>)Json(const Range& elements)
      : value_(Array()) {
    for (const auto& e : elements) push_back(e);
  }
  // An object: {{"name", value}, ...}.
  Json(std::initializer_list<Member> members) : value_(Object(members)) {}
  static Json array();
  static Json object();

  bool is_string() const { return std::holds_alternative<std::string>(value_); }
  bool is_array() const { return std::holds_alternative<Array>(value_); }
  bool is_object() const { return std::holds_alternative<Object>(value_); }

  // A member of an object, made where it is missing; null becomes an object.
  Json& operator[](std::string_view name);
  // A member that is there: contains(name).
  const Json& operator[](std::string_view name) const;
  bool contains(std::string_view name) const;
  const Object& members() const { return std::get<Object>(value_); }

  // Null becomes an array.
  void push_back(Json element);
  const Array& elements() const { return std::get<Array>(value_); }

  const std::string& text() const { return std::get<std::string>(value_); }
  double number() const;

  // On one line, or indented. NaN and infinities are null, bytes that are not UTF-8 are replaced.
  std::string dump(int indent = -1) const;

 private:
  friend struct JsonPrinter;
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Object> value_;
};

}  // namespace obscura::tools

#endif  // OBSCURA_IO_REPORT_JSON_H_
