#ifndef OBSCURA_SCENE_LIGHT_BACKGROUND_H_
#define OBSCURA_SCENE_LIGHT_BACKGROUND_H_

#include <array>

#include "io/images/depth_input.h"
#include "io/images/image.h"
#include "obscura/environment.h"

namespace obscura::tools {

// Where the depth image shows background, writes to an RGB image of the visible size what the
// camera sees of the environment there, or black if it is null. `world_from_eye` is row-major.
void fill_background(const DepthInput& input, const std::array<float, 9>& world_from_eye,
                     const Environment* environment, Image* image);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_LIGHT_BACKGROUND_H_
