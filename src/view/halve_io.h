#ifndef OBSCURA_SRC_VIEW_HALVE_IO_H_
#define OBSCURA_SRC_VIEW_HALVE_IO_H_

#include "gpu/io.h"

IO_BEGIN(halve_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, bool, kNormals, true);
IO_READS(0, Depth, float, depth);
IO_READS(1, Normals, vec4, normals);
IO_WRITES(2, HalfDepth, float, half_depth);
IO_WRITES(3, HalfNormals, vec4, half_normals);
// Along each axis the first pixel, and the shape of the half image.
IO_PUSH(int first_x; int first_y; int half_width; int half_height; int half_left; int half_top;
        int half_visible_width; int half_visible_height;);
IO_END

#endif  // OBSCURA_SRC_VIEW_HALVE_IO_H_
