#include "screen/volumetric/patterns/pattern_tables.h"

namespace obscura::math {

const DiskSample kDisks[] = {
#include "screen/volumetric/patterns/disks.inc"
};

const DiskSample kCenteredDisks[] = {
#include "screen/volumetric/patterns/centered_disks.inc"
};

const BallSample kBalls[] = {
#include "screen/volumetric/patterns/balls.inc"
};

}  // namespace obscura::math
