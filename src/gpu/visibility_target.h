#ifndef OBSCURA_SRC_GPU_VISIBILITY_TARGET_H_
#define OBSCURA_SRC_GPU_VISIBILITY_TARGET_H_

#include "gpu/io.h"

// The part of an interface header of a shader that stores its visibility with store_visibility() of
// gpu/visibility_target.glsl: to the results, or to `visibility`, for a pass that goes on with it.
// kCombine: with what is there already; 1 product, 2 minimum.
#define OBSCURA_VISIBILITY_TARGET       \
  IO_CONSTANT(0, bool, kToImage, true); \
  IO_CONSTANT(1, int, kCombine, 0);     \
  IO_VISIBILITY(0);                     \
  IO_UPDATES(1, Visibility, float, visibility)

#ifdef __cplusplus
#include "gpu/frame.h"

IO_BEGIN(visibility_target_io)
OBSCURA_VISIBILITY_TARGET;
}

namespace obscura::gpu {

enum class CombineWith { kNothing = 0, kProduct = 1, kMinimum = 2 };

// Where one of these shaders leaves its visibility.
struct VisibilityTarget {
  Slot result;  // of the frame
  int region;   // `visibility`; of any size where nothing is stored to it or combined with
  bool to_result = true;
  CombineWith combine = CombineWith::kNothing;

  // Gives a pass its constants and slots.
  void apply(Pass* pass) const {
    namespace io = visibility_target_io;
    pass->constants.emplace_back(io::kToImage, to_result);
    pass->constants.emplace_back(io::kCombine, static_cast<int>(combine));
    pass->slots.push_back({io::kVisibilityResultAt, result});
    pass->slots.push_back({io::kVisibilityAt, region});
  }
};

}  // namespace obscura::gpu
#endif

#endif  // OBSCURA_SRC_GPU_VISIBILITY_TARGET_H_
