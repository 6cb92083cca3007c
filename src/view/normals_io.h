#ifndef OBSCURA_SRC_VIEW_NORMALS_IO_H_
#define OBSCURA_SRC_VIEW_NORMALS_IO_H_

#include "gpu/io.h"

IO_BEGIN(normals_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, bool, kGiven, false);
IO_READS(0, Depth, float, depth);
IO_WRITES(1, Normals, vec4, normals);
IO_IMAGE(2, NormalImage, normal_image);
IO_NO_PUSH;
IO_END

#endif  // OBSCURA_SRC_VIEW_NORMALS_IO_H_
