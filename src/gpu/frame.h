#ifndef OBSCURA_SRC_GPU_FRAME_H_
#define OBSCURA_SRC_GPU_FRAME_H_

#include "gpu/frame_constants.h"
#include "gpu/pass.h"
#include "obscura/frame_shape.h"
#include "obscura/occluder.h"

namespace obscura::gpu {

// Where a method leaves its results: the frame's images, or regions of scratch memory for a pass
// that goes on with them, a float and a vec4 per visible pixel.
struct Results {
  Slot visibility, directions;  // `directions` is that of visibility where none are asked for

  static Results images(const FrameShape& shape) {
    return {Slot::kVisibilityImage, shape.directions == Directions::kNone ? Slot::kVisibilityImage
                                                                          : Slot::kBentNormalImage};
  }
};

// Regions of what every method begins with: linear depth, and normals where they are wanted.
struct Geometry {
  int depth = -1, normals = -1, back = -1;  // -1: not there; `back`: where matter ends
};

// The frames that a method works on.
struct Frame {
  FrameShape shape;
  Results results;
  Geometry geometry{};  // what of it is there already

  bool directions() const { return shape.directions != Directions::kNone; }
  Extent visible() const { return shape.visible(); }
  // Of a value of so many floats per visible pixel.
  std::uint64_t visible_bytes(int floats = 1) const {
    return std::uint64_t{sizeof(float)} * static_cast<std::uint64_t>(floats) * visible().pixels();
  }
};

// What a method asks of a frame and what it gives.
struct Demands {
  const char* method;
  bool normals = false;
  bool directions = false;
};

// Whether a frame meets them.
Status check(const Demands& demands, const FrameShape& shape);

// Whether there is the image of back depth that an occluder asks for.
Status check_back_depth(const Occluder& occluder, const FrameShape& shape);

// Sizes, guard band and number of frames.
Status check(const FrameShape& shape);

FrameConstants frame_constants(const FrameShape& shape, const Camera& camera,
                               const FrameView& view);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_GPU_FRAME_H_
