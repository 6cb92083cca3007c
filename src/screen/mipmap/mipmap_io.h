#ifndef OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_IO_H_
#define OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_IO_H_

#include "gpu/io.h"
#include "gpu/rho_words.h"

IO_BEGIN(mipmap_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, int, kFalloff, 1);  // FalloffKind
IO_CONSTANT(1, int, kDirections, 16);
IO_CONSTANT(2, bool, kInterpolate, true);
IO_READS(0, Tables, uvec4, quads);
IO_READS(1, Depth, float, depth);
IO_READS(2, Pyramid, float, pyramid);
IO_READS(3, Normals, vec4, normals);
IO_VISIBILITY(4);
// Where in the tables rho, levels, directions and steps start, in quads, and the numbers of the
// last two.
IO_PUSH(OBSCURA_RHO_WORDS int rho_start; int levels; int directions; int steps; int step_count;
        int level_count;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_MIPMAP_MIPMAP_IO_H_
