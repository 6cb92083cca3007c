// What passes derive from the frame's numbers, which are `view` (gpu/frame_constants.h). After the
// shader's interface header.
#define kInf uintBitsToFloat(0x7f800000u)

// Where in a pattern that repeats from pixel to pixel a pixel stands in this frame: over 16 frames
// each takes every place of a pattern of 4x4.
ivec2 pattern_place(ivec2 pixel) {
  return pixel + ivec2(view.frame_index & 0xFFFF, (view.frame_index >> 2) & 0x3FFF);
}
