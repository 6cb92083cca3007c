// Where a pass of volumetric obscurance leaves its visibility: in the frame's image, or in scratch
// memory for the pass that goes on with it (vulkan/volumetric.h).
layout(constant_id = 0) const bool kToImage = true;
layout(constant_id = 1) const int kCombine = 0;  // with what is there: 1 product, 2 minimum
layout(binding = 0) uniform writeonly image2D visibility_image;
layout(binding = 1) buffer Visibility { float visibility[]; };

void store_visibility(ivec2 p, float open) {
  const int i = p.y * view.visible_width + p.x;
  float v = clamp(open, 0.0, 1.0);
  if (kCombine == 1) v *= visibility[i];
  if (kCombine == 2) v = min(v, visibility[i]);
  if (kToImage) {
    imageStore(visibility_image, p, vec4(v));
  } else {
    visibility[i] = v;
  }
}
