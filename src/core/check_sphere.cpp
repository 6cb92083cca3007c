#include "core/check_sphere.h"

#include <cmath>

#include "core/text.h"

namespace obscura {

Status check_sphere(const Falloff& falloff, std::string_view method) {
  if (Status s = validate(falloff); !s.ok()) return s;
  if (falloff.kind != FalloffKind::kConstant && falloff.kind != FalloffKind::kQuadratic) {
    return invalid_argument(text(
        "falloff is ", static_cast<int>(falloff.kind) < 4 ? enum_name(falloff.kind) : "a curve",
        "; ", method, " takes constant or quadratic"));
  }
  if (std::isinf(falloff.radius)) {
    return invalid_argument(text("radius is inf; ", method, " needs a finite sphere"));
  }
  return {};
}

Status check_sphere(const Falloff& falloff, const Occluder& occluder, std::string_view method) {
  if (Status s = check_sphere(falloff, method); !s.ok()) return s;
  if (Status s = validate(occluder); !s.ok()) return s;
  if (occluder.kind != OccluderKind::kSolid && occluder.kind != OccluderKind::kThickness) {
    return invalid_argument(text("occluder is ", enum_name(occluder.kind), "; ", method,
                                 " takes solid or thickness:T"));
  }
  return {};
}

}  // namespace obscura
