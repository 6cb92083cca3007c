#ifndef OBSCURA_SCENE_VOLUMES_VDB_DISTANCE_H_
#define OBSCURA_SCENE_VOLUMES_VDB_DISTANCE_H_

#include "obscura/volume.h"

namespace obscura::tools {

// Signed distances by OpenVDB's fogToSdf, to compare with: values above the isovalue are matter,
// distances positive in the open. `seconds` is of the sweep alone, without turning dense arrays
// into a grid and back.
// Requires: dense f32 voxels of equal spacing, without slope and intercept; has_openvdb().
Status openvdb_distance(const VolumeView& volume, float isovalue, int threads,
                        GridView<float> distance, double* seconds);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_VOLUMES_VDB_DISTANCE_H_
