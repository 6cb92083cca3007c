#ifndef OBSCURA_DUAL_RADIUS_H_
#define OBSCURA_DUAL_RADIUS_H_

#include <optional>

#include "obscura/export.h"
#include "obscura/settings.h"

namespace obscura {

// How the results of two radii become one (Loos and Sloan 2010, section 6).
enum class Combine {
  kProduct,
  kMinimum,
};
template <>
struct EnumNames<Combine> {
  static constexpr const char* names[] = {"product", "minimum"};
};

// A length that need not be given.
using OptionalLength = std::optional<float>;
template <>
struct OBSCURA_API SettingText<OptionalLength> {
  static constexpr const char* form = "none or a number in (0, inf)";
  static bool parse(std::string_view text, OptionalLength* value);
  static std::string write(const OptionalLength& value);
};

// Volumetric obscurance with a second sphere: small ones show fine features, large ones contact and
// large-scale shadow.
struct DualRadius {
  OptionalLength second_radius{};
  Combine combine = Combine::kProduct;
};
template <FieldsOf<DualRadius> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.second_radius, Field{"second_radius", "world units", {}, "Radius of a second sphere."});
  v(s.combine, Field{"combine", "", {}, "How the results of both radii are combined."});
}

OBSCURA_API Status validate(const DualRadius& dual);

}  // namespace obscura

#endif  // OBSCURA_DUAL_RADIUS_H_
