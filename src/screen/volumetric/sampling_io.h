#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_SAMPLING_IO_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_SAMPLING_IO_H_

#include "gpu/visibility_target.h"

// What the shaders of one radius of line, point and area sampling have in common after
// OBSCURA_VISIBILITY_TARGET. Tables: the tile of reflections first, x, y (and z) per pixel; where
// the push constants say, the pattern, values per sample.
#define OBSCURA_SAMPLING                   \
  IO_CONSTANT(2, int, kSamples, 9);        \
  IO_CONSTANT(3, bool, kNormals, true);    \
  IO_CONSTANT(4, bool, kRotate, true);     \
  IO_CONSTANT(5, bool, kThickness, false); \
  IO_CONSTANT(6, int, kNoise, 64);         \
  IO_READS(2, Depth, float, depth);        \
  IO_READS(3, Normals, vec4, normals);     \
  IO_READS(4, Tables, float, tables)

#ifdef __cplusplus
IO_BEGIN(sampling_io)
OBSCURA_SAMPLING;
}
#endif

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_SAMPLING_IO_H_
