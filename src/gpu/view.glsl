// What all passes know of the frame; src/gpu/frame_constants.h has the same block in C++. A shader
// defines PASS_CONSTANTS before it includes this if it has more (Pass::push).
#ifndef PASS_CONSTANTS
#define PASS_CONSTANTS
#endif
layout(push_constant) uniform View {
  float scale_x, scale_y, center_u, center_v;
  int width, height, left, top;
  int visible_width, visible_height;
  float near_plane, far_plane;
  int orthographic, frame_index;
  float radius, thickness;
  PASS_CONSTANTS
} view;

#define kInf uintBitsToFloat(0x7f800000u)

// Where in a pattern that repeats from pixel to pixel a pixel stands in this frame: over 16 frames
// each takes every place of a pattern of 4x4.
ivec2 pattern_place(ivec2 pixel) {
  return pixel + ivec2(view.frame_index & 0xFFFF, (view.frame_index >> 2) & 0x3FFF);
}
