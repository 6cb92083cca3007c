#ifndef OBSCURA_FRAME_SHAPE_H_
#define OBSCURA_FRAME_SHAPE_H_

#include <cstdint>
#include <limits>

#include "obscura/camera.h"
#include "obscura/depth_field.h"
#include "obscura/views.h"

// What an estimator on a GPU has to know of the caller's frames, whatever draws them.
namespace obscura::gpu {

// How a bent normal and its cone are stored in one image. Alpha is the cone's half angle divided by
// pi/2.
enum class Directions {
  kNone,
  kSigned,    // rgb is the bent normal: RGBA16_SFLOAT, RGBA32_SFLOAT, RGBA8_SNORM
  kUnsigned,  // rgb is half the bent normal plus one half: RGBA8_UNORM
};

// What stays the same from frame to frame.
struct FrameShape {
  int width = 0, height = 0;  // whole depth image, guard band included; 1 to 16384 a side
  GuardBand guard_band{};
  DepthKind depth_kind = DepthKind::kLinear;
  bool normals = false;  // an image of normals is given; else they come from depth
  NormalUse normal_use = NormalUse::kAuto;
  bool back_depth = false;  // an image of where the first layer's matter ends is given
  Directions directions = Directions::kNone;
  int frames = 2;  // sets of images that may be in flight, 1 to 8

  Extent size() const { return {width, height}; }
  Extent visible() const { return guard_band.inside(size()); }
};

// What may change with each frame.
struct FrameView {
  Camera camera{};
  float near_plane = 0;  // for the NDC kinds: (0, far_plane)
  float far_plane = std::numeric_limits<float>::infinity();
  // For a temporal filter: random and interleaved patterns move from pixel to pixel with it, so
  // that the mean over 16 frames is that of 16 patterns. 0 gives what the CPU gives.
  std::uint32_t frame_index = 0;
};

}  // namespace obscura::gpu

#endif  // OBSCURA_FRAME_SHAPE_H_
