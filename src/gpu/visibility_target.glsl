// Leaves visibility with the results, or in scratch memory (gpu/visibility_target.h).
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
