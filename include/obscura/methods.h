#ifndef OBSCURA_METHODS_H_
#define OBSCURA_METHODS_H_

#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "obscura/area.h"
#include "obscura/export.h"
#include "obscura/far_field.h"
#include "obscura/hemisphere.h"
#include "obscura/horizon.h"
#include "obscura/line.h"
#include "obscura/mipmap.h"
#include "obscura/point.h"
#include "obscura/reference.h"
#include "obscura/status.h"

namespace obscura {

// Every method of the library, by its settings. This is the list that commands, pages, devices and
// bindings go through; what is said of a method stands beside its settings (MethodInfo).
using MethodSettings = std::variant<  //
    AreaSettings,                     //
    FarFieldSettings,                 //
    HemisphereSettings,               //
    HorizonSettings,                  //
    LineSettings,                     //
    MipmapSettings,                   //
    PointSettings,                    //
    ReferenceSettings>;

// Calls f(MethodInfo<Settings>(), Settings()) for every method, in the order of the list.
template <class F>
void for_each_method(F&& f) {
  [&]<class... Settings>(std::type_identity<std::variant<Settings...>>) {
    (f(MethodInfo<Settings>(), Settings()), ...);
  }(std::type_identity<MethodSettings>());
}

// Calls f(value, field) for every field of the settings that a variant holds, const or not.
template <class... Settings, class F>
void for_each_field(std::variant<Settings...>& settings, F&& f) {
  std::visit([&](auto& s) { visit_fields(s, f); }, settings);
}
template <class... Settings, class F>
void for_each_field(const std::variant<Settings...>& settings, F&& f) {
  std::visit([&](const auto& s) { visit_fields(s, f); }, settings);
}

// The name of the method that the settings belong to: "far-field".
OBSCURA_API std::string_view method_name(const MethodSettings& settings);

// The names of all methods, in the order of the list.
OBSCURA_API std::vector<std::string_view> method_names();

// The settings of a method at their defaults; for an unknown name the message lists those there
// are, and `settings` stays as it was.
OBSCURA_API Status make_settings(std::string_view method, MethodSettings* settings);

// Sets one field, by its C++ name, from text as the command line takes it: set(&s, "radius", "2").
// On failure the message says what would be right, and `settings` stays as it was.
OBSCURA_API Status set(MethodSettings* settings, std::string_view field, std::string_view text);

}  // namespace obscura

#endif  // OBSCURA_METHODS_H_
