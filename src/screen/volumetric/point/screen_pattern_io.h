#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_IO_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_IO_H_

#include "gpu/io.h"

IO_BEGIN(screen_pattern_io)
IO_THREADS(8, 8);
IO_CONSTANT(0, int, kSamples, 12);
IO_CONSTANT(1, bool, kNormals, true);
IO_CONSTANT(2, bool, kRotate, true);
IO_CONSTANT(3, bool, kQuadratic, false);
IO_CONSTANT(4, bool, kDirections, false);
IO_CONSTANT(5, int, kNoise, 64);
IO_READS(0, Depth, float, depth);
IO_READS(1, Normals, vec4, normals);
// Per pixel of the tile of reflections x, y; per sample x, y, weight.
IO_READS(2, Tables, float, tables);
IO_WRITES(3, Open, float, open_sums);
IO_WRITES(4, Directions, vec4, sums);
IO_PUSH(int pattern; float angle_grain;);  // where the samples start in the tables
IO_END

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_POINT_SCREEN_PATTERN_IO_H_
