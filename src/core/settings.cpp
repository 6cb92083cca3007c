#include "obscura/settings.h"

#include "core/text.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"

namespace obscura {

std::string to_string(const Range& range) {
  auto bound = [](double v) {
    return std::isinf(v) ? std::string(v < 0 ? "-inf" : "inf") : text(v);
  };
  const bool open_below = range.min_excluded || std::isinf(range.min);
  const bool open_above = range.max_excluded;
  return text(open_below ? "(" : "[", bound(range.min), ", ", bound(range.max),
              open_above ? ")" : "]");
}

Status out_of_range(const Field& field, double value) {
  return invalid_argument(
      text(field.name, " is ", value, "; it must be in ", to_string(field.range)));
}

Status validate(const Falloff& falloff) {
  if (falloff.kind == FalloffKind::kFunction) {
    if (!falloff.function) return invalid_argument("falloff.function is empty; give a callable");
    return {};
  }
  if (Status s = validate_ranges(falloff); !s.ok()) return s;
  if (falloff.kind == FalloffKind::kTable) {
    if (falloff.table.size() < 2) {
      return invalid_argument(
          text("falloff.table has ", falloff.table.size(), " values; it needs at least 2"));
    }
    for (float v : falloff.table) {
      if (!(v >= 0 && v <= 1)) {
        return invalid_argument(text("falloff.table holds ", v, "; values must be in [0, 1]"));
      }
    }
    if (std::isinf(falloff.radius)) {
      return invalid_argument("radius is inf; a falloff table needs a finite one");
    }
  }
  return {};
}

Status validate(const Occluder& occluder) {
  if (occluder.kind == OccluderKind::kThickness &&
      !(occluder.thickness > 0 && std::isfinite(occluder.thickness))) {
    return invalid_argument(
        text("occluder thickness is ", occluder.thickness, "; it must be in (0, inf)"));
  }
  if (occluder.kind == OccluderKind::kLayers && (occluder.layers < 1 || occluder.layers > 64)) {
    return invalid_argument(
        text("occluder layers is ", occluder.layers, "; it must be in [1, 64]"));
  }
  return {};
}

}  // namespace obscura
