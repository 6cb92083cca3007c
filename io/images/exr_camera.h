#ifndef OBSCURA_IO_IMAGES_EXR_CAMERA_H_
#define OBSCURA_IO_IMAGES_EXR_CAMERA_H_

#include <string>

#include "io/images/depth_input.h"
#include "io/images/exr.h"
#include "obscura/camera.h"

namespace obscura::tools {

struct ExrCamera {
  Camera camera;  // in pixels of the window asked for
  bool looks_along_plus_z = true;
};

// The camera of the attributes worldToCamera and worldToNDC, which the header must have, for an
// image over `window`. OpenEXR's matrices act on row vectors, p' = p M. Supported are
// - camera space with z forward, as OpenEXR defines it, or with z backward;
// - NDC as OpenEXR defines it: (0, 0) and (1, 1) at the upper left and lower right corners of the
//   display window; or, where y points up, (-1, -1) and (1, 1) at its lower left and upper right;
// - perspective and parallel views, off-centre too; not mirrored, rolled or sheared ones, since
//   camera space has x and y along the image.
Status camera_from_exr(const std::string& path, const ExrHeader& header, const PixelWindow& window,
                       ExrCamera* camera);

// Takes normals from world to eye space by the inverse transpose of worldToCamera.
void normals_to_eye_space(const ExrHeader::Matrix& world_to_camera, bool looks_along_plus_z,
                          DepthInput* input);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_EXR_CAMERA_H_
