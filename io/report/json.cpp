#include "io/report/json.h"

#include <algorithm>

#include "nlohmann/json.hpp"

namespace obscura::tools {

struct JsonPrinter {
  static nlohmann::ordered_json printable(const Json& json) {
    return std::visit([](const auto& value) { return of(value); }, json.value_);
  }
  static nlohmann::ordered_json of(std::monostate) { return nullptr; }
  static nlohmann::ordered_json of(const auto& value) { return value; }
  static nlohmann::ordered_json of(const Json::Array& elements) {
    auto array = nlohmann::ordered_json::array();
    for (const Json& e : elements) array.push_back(printable(e));
    return array;
  }
  static nlohmann::ordered_json of(const Json::Object& members) {
    auto object = nlohmann::ordered_json::object();
    for (const Json::Member& m : members) object[m.name] = printable(m.value);
    return object;
  }
};

Json Json::array() {
  Json json;
  json.value_ = Array();
  return json;
}

Json Json::object() {
  Json json;
  json.value_ = Object();
  return json;
}

Json& Json::operator[](std::string_view name) {
  if (std::holds_alternative<std::monostate>(value_)) value_ = Object();
  auto& members = std::get<Object>(value_);
  auto member = std::ranges::find(members, name, &Member::name);
  if (member == members.end()) member = members.insert(member, {std::string(name), {}});
  return member->value;
}

const Json& Json::operator[](std::string_view name) const {
  return std::ranges::find(members(), name, &Member::name)->value;
}

bool Json::contains(std::string_view name) const {
  return std::ranges::find(members(), name, &Member::name) != members().end();
}

void Json::push_back(Json element) {
  if (std::holds_alternative<std::monostate>(value_)) value_ = Array();
  std::get<Array>(value_).push_back(std::move(element));
}

double Json::number() const {
  const auto* whole = std::get_if<std::int64_t>(&value_);
  return whole ? static_cast<double>(*whole) : std::get<double>(value_);
}

std::string Json::dump(int indent) const {
  return JsonPrinter::printable(*this).dump(indent, ' ', false,
                                            nlohmann::json::error_handler_t::replace);
}

}  // namespace obscura::tools
