#ifndef OBSCURA_SRC_VIEW_MATTER_H_
#define OBSCURA_SRC_VIEW_MATTER_H_

#include "obscura/occluder.h"

namespace obscura::view {

// Where the matter of a texel ends, for kernels: nowhere, a thickness behind its front along the
// view ray, or at an image's depth. view/matter_io.h has the same numbers for shaders.
enum class Matter { kSolid, kThickness, kWithBack };

// Of a valid occluder without layers.
inline Matter matter_of(const Occluder& occluder) {
  if (occluder.kind == OccluderKind::kSolid) return Matter::kSolid;
  return occluder.kind == OccluderKind::kThickness ? Matter::kThickness : Matter::kWithBack;
}

}  // namespace obscura::view

#endif  // OBSCURA_SRC_VIEW_MATTER_H_
