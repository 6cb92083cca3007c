#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_FILL_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_FILL_IO_H_

#include "gpu/io.h"
#include "view/matter_io.h"

IO_BEGIN(far_field_fill_io)
IO_NUMBER(kTile, 32);
OBSCURA_MATTER_KINDS;
IO_THREADS(32, 8);
IO_TILE(kTile, kTile);
IO_CONSTANT(0, int, kOccluder, 0);
IO_READS(0, Depth, float, depth);
IO_READS(1, Receivers, vec4, receivers);
IO_WRITES(2, Lattice, float, lattice);
IO_WRITES(3, Turned, vec4, turned_receivers);
IO_WRITES(4, Back, float, backs);
IO_READS(5, GivenBack, float, given_backs);
IO_PUSH(int transposed; int lattice_stride; int margin;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_FILL_IO_H_
