#ifndef OBSCURA_SRC_VOLUME_DISTANCE_PASS_H_
#define OBSCURA_SRC_VOLUME_DISTANCE_PASS_H_

#include "core/progress.h"
#include "obscura/executor.h"
#include "obscura/volume.h"
#include "volume/distance_kernel.h"

namespace obscura {

// One direction along z. Each plane is swept in two stages of two orders each; a stage needs only
// its own previous plane, so the second stage runs one plane behind the first. Threads take parts
// of both stages in an order in which a part waits for parts taken before it only. False where
// progress says to stop. Both stages have begun the pass.
bool sweep_distance_pass(GridView<float> distance, bool rising, DistanceStage& first,
                         DistanceStage& second, Executor& executor, int workers,
                         Progress& progress);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_DISTANCE_PASS_H_
