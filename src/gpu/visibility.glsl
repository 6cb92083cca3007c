// Where a pass of volumetric obscurance leaves its visibility: with the results, or in scratch
// memory for the pass that goes on with it (gpu/volumetric.h).
layout(constant_id = 0) const bool kToImage = true;
layout(constant_id = 1) const int kCombine = 0;  // with what is there: 1 product, 2 minimum
layout(binding = 1) buffer Visibility { float visibility[]; };
#define VISIBILITY_BINDING 0
#include "gpu/results.glsl"

void store_visibility(ivec2 p, float open) {
  const int i = p.y * view.visible_width + p.x;
  float v = clamp(open, 0.0, 1.0);
  if (kCombine == 1) v *= visibility[i];
  if (kCombine == 2) v = min(v, visibility[i]);
  if (kToImage) {
    write_visibility(p, v);
  } else {
    visibility[i] = v;
  }
}
