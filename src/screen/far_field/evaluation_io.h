#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_EVALUATION_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_EVALUATION_IO_H_

#include "gpu/io.h"
#include "gpu/rho_words.h"

// What both evaluations have in common, solid and finite occluders.
#define OBSCURA_EVALUATION                                                                 \
  IO_THREADS(32, 4);                                                                       \
  IO_CONSTANT(0, int, kFalloff, 1); /* FalloffKind */                                      \
  IO_CONSTANT(1, bool, kChord, true);                                                      \
  IO_CONSTANT(2, int, kSums, 0);   /* SliceSums */                                         \
  IO_CONSTANT(3, int, kSide, 1);   /* of groups of pixels that share or jitter */          \
  IO_CONSTANT(4, int, kPhases, 1); /* of a row's receivers */                              \
  IO_CONSTANT(5, int, kLineStep, 1);                                                       \
  IO_CONSTANT(6, int, kSegments, 2);                                                       \
  IO_CONSTANT(7, bool, kJitter, false);                                                    \
  IO_READS(0, Tables, uvec4, quads);                                                       \
  IO_READS(1, Lattice, float, lattice);                                                    \
  IO_READS(2, Receivers, vec4, receivers);                                                 \
  IO_UPDATES(3, PlaneSums, float, sums);                                                   \
  IO_READS(6, Dense, uint, dense);                                                         \
  IO_CONSTANT(8, int, kTilePixels, 32);                                                    \
  IO_PUSH(OBSCURA_RHO_WORDS int rho_start; int transposed; int lattice_stride; int margin; \
          int directions; int direction_count; int sum_stride; int add; float slope;)

#ifdef __cplusplus
IO_BEGIN(evaluation_io)
OBSCURA_EVALUATION;
}
#endif

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_EVALUATION_IO_H_
