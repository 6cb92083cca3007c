#ifndef OBSCURA_APPS_MPI_VOLUME_RANKS_H_
#define OBSCURA_APPS_MPI_VOLUME_RANKS_H_

#include <string>

#include "apps/mpi/ranks.h"
#include "io/volumes/planes.h"
#include "scene/volumes/field_blocks.h"

namespace obscura::mpi {

// A volume's field, computed by all ranks together: a slab of planes each, boundary planes sent
// from rank to rank.
struct VolumeJob {
  std::string output;
  tools::FieldsKind kind = tools::FieldsKind::kOctants;
  DistanceSettings distance;
  OcclusionSettings occlusion;
  std::vector<int> planes;  // of each rank; empty: as equal as may be
  int threads = 1;          // of each rank
};

// What each rank took, in seconds.
struct VolumeTimes {
  double read = 0, distance = 0, light = 0, write = 0;
};

Status run_volume_job(const Ranks& ranks, const tools::PlaneFile& file, const VolumeJob& job,
                      VolumeTimes* times);

}  // namespace obscura::mpi

#endif  // OBSCURA_APPS_MPI_VOLUME_RANKS_H_
