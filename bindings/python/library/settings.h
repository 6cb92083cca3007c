#ifndef OBSCURA_BINDINGS_PYTHON_LIBRARY_SETTINGS_H_
#define OBSCURA_BINDINGS_PYTHON_LIBRARY_SETTINGS_H_

#include <pybind11/stl.h>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "library/arrays.h"
#include "obscura/settings.h"

namespace obscura::python {

// Settings as the Python files give them: names and texts.
using GivenSettings = std::vector<std::pair<std::string, std::string>>;

// Reads the fields that are named; `what` has them, for the message.
template <class Settings>
Settings read_settings(const char* what, const GivenSettings& given) {
  Settings settings;
  for (const auto& [name, text] : given) {
    bool known = false;
    visit_fields(settings, [&, &name = name, &text = text](auto& value, const Field& field) {
      if (name != field.name) return;
      known = true;
      raise(parse_setting(name, field, text, &value));
    });
    if (!known) throw py::type_error(std::string(what) + " has no setting '" + name + "'");
  }
  return settings;
}

// Name, unit, what it may be, default, help and type of a field: bool, int, float, text, or the
// names of an enumeration with | between them.
using SettingRow = std::array<std::string, 6>;

template <class Settings>
std::vector<SettingRow> setting_rows() {
  std::vector<SettingRow> rows;
  const Settings defaults;
  visit_fields(defaults, [&](const auto& value, const Field& f) {
    using T = std::remove_cvref_t<decltype(value)>;
    std::string type = std::is_same_v<T, bool>       ? "bool"
                       : std::is_integral_v<T>       ? "int"
                       : std::is_floating_point_v<T> ? "float"
                                                     : "text";
    if constexpr (std::is_enum_v<T>) {
      type.clear();
      for (const char* name : enum_names<T>())
        type += (type.empty() ? "" : "|") + std::string(name);
    }
    rows.push_back({f.name, f.unit, expected_text<T>(f), write_setting(value), f.help, type});
  });
  return rows;
}

}  // namespace obscura::python

#endif  // OBSCURA_BINDINGS_PYTHON_LIBRARY_SETTINGS_H_
