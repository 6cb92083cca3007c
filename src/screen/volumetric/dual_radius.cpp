#include "obscura/dual_radius.h"

#include <cmath>

#include "core/text.h"

namespace obscura {

bool SettingText<OptionalLength>::parse(std::string_view given, OptionalLength* value) {
  if (given == "none") {
    value->reset();
    return true;
  }
  double number;
  if (!parse_number(given, &number)) return false;
  const float length = static_cast<float>(number);
  if (!(length > 0 && std::isfinite(length))) return false;
  *value = length;
  return true;
}

std::string SettingText<OptionalLength>::write(const OptionalLength& value) {
  return value ? write_number(*value, true) : "none";
}

Status validate(const DualRadius& dual) {
  if (!dual.second_radius || (*dual.second_radius > 0 && std::isfinite(*dual.second_radius))) {
    return {};
  }
  return invalid_argument(
      text("second_radius is ", *dual.second_radius, "; it must be in (0, inf), or none"));
}

}  // namespace obscura
