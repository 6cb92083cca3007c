#ifndef OBSCURA_SRC_FILTERS_UPSAMPLING_UPSAMPLING_IO_H_
#define OBSCURA_SRC_FILTERS_UPSAMPLING_UPSAMPLING_IO_H_

#include "gpu/io.h"

IO_BEGIN(upsampling_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, bool, kNormals, true);
IO_CONSTANT(1, bool, kDirections, false);
IO_CONSTANT(2, bool, kUnsigned, false);
IO_READS(0, Depth, float, depth);
IO_READS(1, Normals, vec4, normals);
IO_READS(2, Seen, float, seen);
IO_READS(3, SeenDirections, vec4, seen_directions);
IO_VISIBILITY(4);
IO_DIRECTIONS(5);
IO_PUSH(float edge;);
IO_END

#endif  // OBSCURA_SRC_FILTERS_UPSAMPLING_UPSAMPLING_IO_H_
