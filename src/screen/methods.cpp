#include "obscura/methods.h"

#include "core/text.h"

namespace obscura {

std::string_view method_name(const MethodSettings& settings) {
  return std::visit(
      [](const auto& s) { return MethodInfo<std::remove_cvref_t<decltype(s)>>::name; }, settings);
}

std::vector<std::string_view> method_names() {
  std::vector<std::string_view> names;
  for_each_method([&](auto info, const auto&) { names.push_back(info.name); });
  return names;
}

Status make_settings(std::string_view method, MethodSettings* settings) {
  std::vector<const char*> names;
  bool found = false;
  for_each_method([&](auto info, auto defaults) {
    names.push_back(info.name);
    if (method != info.name) return;
    *settings = std::move(defaults);
    found = true;
  });
  return found ? Status() : bad_setting("method", method, one_of(names));
}

Status set(MethodSettings* settings, std::string_view name, std::string_view given) {
  std::vector<const char*> names;
  bool found = false;
  Status status;
  for_each_field(*settings, [&](auto& value, const Field& field) {
    names.push_back(field.name);
    if (name != field.name) return;
    found = true;
    status = parse_setting(name, field, given, &value);
  });
  if (found) return status;
  return invalid_argument(
      text(method_name(*settings), " has no field '", name, "'; it must be ", one_of(names)));
}

}  // namespace obscura
