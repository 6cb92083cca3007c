#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SCAN_IO_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SCAN_IO_H_

#include "gpu/io.h"

IO_BEGIN(far_field_scan_io)
IO_NUMBER(kLinesPerGroup, 32);
IO_NUMBER(kStripsPerGroup, 8);
IO_NUMBER(kSharedLevels, 4);  // of the pyramid, that a group makes: itself and those of its strips
IO_THREADS(kLinesPerGroup, kStripsPerGroup);
IO_CONSTANT(0, int, kInterval, 10);
IO_CONSTANT(1, bool, kFinite, false);
IO_READS(0, Tables, uvec4, quads);
IO_READS(1, Lattice, float, lattice);
IO_READS(2, Back, float, backs);
IO_WRITES(3, Raw, vec2, raw);  // nearest, slanted
IO_WRITES(4, Pieces, vec4,
          pieces);  // nearest, slanted, deepest, end; front, back, filled of the rest
IO_PUSH(int transposed; int lattice_stride; int margin; int directions; int line_stride;
        int line_step; float slope;);
IO_END

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FAR_FIELD_SCAN_IO_H_
