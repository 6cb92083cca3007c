#ifndef OBSCURA_IO_SEQUENCES_CAMERA_LIST_H_
#define OBSCURA_IO_SEQUENCES_CAMERA_LIST_H_

#include <array>
#include <string>
#include <vector>

#include "obscura/status.h"

namespace obscura::tools {

// The 16 numbers of a projection matrix, row-major, for column vectors, depth from 0 to 1.
using ProjectionMatrix = std::array<double, 16>;

// Reads a JSON file of projection matrices, one for each of `frames`: a list with exactly one
// matrix per frame, in the frames' order, or an object whose names are frame numbers
// ({"1": [...], "2": [...]}), which may have more. A matrix is 16 numbers or 4 rows of 4. A file
// that lacks one is refused with the first frame without a matrix.
Status read_cameras(const std::string& path, const std::vector<int>& frames,
                    std::vector<ProjectionMatrix>* cameras);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_SEQUENCES_CAMERA_LIST_H_
