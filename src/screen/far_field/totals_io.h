#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_IO_H_

#include "gpu/io.h"

// What the passes that may write the results have in common.
#define OBSCURA_TOTALS                           \
  IO_CONSTANT(0, int, kSums, 0); /* SliceSums */ \
  IO_CONSTANT(1, bool, kPaperCone, false);       \
  IO_CONSTANT(2, bool, kUnsigned, false);        \
  IO_VISIBILITY(0);                              \
  IO_DIRECTIONS(1);                              \
  IO_READS(2, Normals, vec4, normals)

#ifdef __cplusplus
IO_BEGIN(totals_io)
OBSCURA_TOTALS;
}
#endif

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_TOTALS_IO_H_
