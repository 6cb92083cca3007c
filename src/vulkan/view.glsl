// What all passes know of the frame; src/vulkan/frame_constants.h has the same block in C++. A shader
// defines PASS_CONSTANTS before it includes this if it has more (Pass::push).
#ifndef PASS_CONSTANTS
#define PASS_CONSTANTS
#endif
layout(push_constant) uniform View {
  float scale_x, scale_y, center_u, center_v;
  int width, height, left, top;
  int visible_width, visible_height;
  float near_plane, far_plane;
  int orthographic;
  float radius, thickness;
  PASS_CONSTANTS
} view;

#define kInf uintBitsToFloat(0x7f800000u)
