#ifndef OBSCURA_SRC_SCREEN_VOLUMETRIC_PATTERNS_PATTERN_TABLES_H_
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_PATTERNS_PATTERN_TABLES_H_

#include "obscura/patterns.h"

namespace obscura::math {

// Patterns of 1, 2, ... samples, one after the other: that of n starts at n (n - 1) / 2.
extern const DiskSample kDisks[kMaxDiskSamples * (kMaxDiskSamples + 1) / 2];
extern const DiskSample kCenteredDisks[kMaxDiskSamples * (kMaxDiskSamples + 1) / 2];
extern const BallSample kBalls[kMaxBallSamples * (kMaxBallSamples + 1) / 2];

}  // namespace obscura::math

#endif  // OBSCURA_SRC_SCREEN_VOLUMETRIC_PATTERNS_PATTERN_TABLES_H_
