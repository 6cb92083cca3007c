#include "scene/views/view_options.h"

#include <fmt/format.h>

#include <numbers>

namespace obscura {
namespace tools {

Status apply_options(const ViewOptions& options, ViewSpec* view) {
  ViewSpec v = *view;
  if (options.fov_y && options.ortho_height) {
    return invalid_argument("fov-y and ortho-height are both given; a view has one of them");
  }
  v.width = options.size.width;
  v.height = options.size.height;
  v.guard_band = options.guard_band.resolve(options.size);
  v.eye = options.eye.value_or(v.eye);
  v.look_at = options.look_at.value_or(v.look_at);
  v.up = options.up.value_or(v.up);
  if (options.fov_y) {
    v.orthographic = false;
    v.fov_y = *options.fov_y * std::numbers::pi / 180;
  }
  if (options.ortho_height) {
    v.orthographic = true;
    v.ortho_height = *options.ortho_height;
  }
  if (Status s = validate(v); !s.ok()) return s;
  *view = v;
  return {};
}

}  // namespace tools

bool SettingText<std::optional<tools::Vec3>>::parse(std::string_view text,
                                                    std::optional<tools::Vec3>* value) {
  double n[3];
  if (!tools::parse_numbers(text, ',', 3, n)) return false;
  *value = tools::Vec3{n[0], n[1], n[2]};
  return true;
}

std::string SettingText<std::optional<tools::Vec3>>::write(
    const std::optional<tools::Vec3>& value) {
  return value ? fmt::format("{:g},{:g},{:g}", value->x, value->y, value->z) : "";
}

}  // namespace obscura
