#ifndef OBSCURA_SRC_VOLUME_DISTANCE_START_H_
#define OBSCURA_SRC_VOLUME_DISTANCE_START_H_

#include "obscura/volume.h"

namespace obscura {

// Writes the signed distances of the voxels beside the isosurface and +-kUnknownDistance elsewhere.
// `distance` has the volume's planes from `first` on; planes of the volume before and after them
// are their neighbours. The settings are valid.
void start_distance(const VolumeView& volume, int first, const DistanceSettings& settings,
                    GridView<float> distance, Executor& executor);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_DISTANCE_START_H_
