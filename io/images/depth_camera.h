#ifndef OBSCURA_IO_IMAGES_DEPTH_CAMERA_H_
#define OBSCURA_IO_IMAGES_DEPTH_CAMERA_H_

#include <string>

#include "io/images/depth_file.h"

namespace obscura::tools {

bool gives_camera(const DepthFileOptions& options);

// The camera that the options say, for an image whose size and guard band are known; and near and
// far planes, where a projection has them and the depth kind needs them. A left-handed projection
// is turned, with a note; one that looks transposed is refused.
Status set_camera(const std::string& path, const DepthFileOptions& options, DepthInput* input);

// A matrix as text: 16 numbers, or 9 for its upper left 3x3 part, row-major, for column vectors.
Status read_matrix(const std::string& path, const char* what, double matrix[16]);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_IMAGES_DEPTH_CAMERA_H_
