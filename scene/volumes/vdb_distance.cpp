#include "scene/volumes/vdb_distance.h"

#ifdef OBSCURA_WITH_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <openvdb/tools/FastSweeping.h>
#include <tbb/global_control.h>

#include <chrono>
#endif

namespace obscura::tools {

#ifdef OBSCURA_WITH_OPENVDB

Status openvdb_distance(const VolumeView& volume, float isovalue, int threads,
                        GridView<float> distance, double* seconds) {
  using Dense = openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ>;
  using ConstDense = openvdb::tools::Dense<const float, openvdb::tools::LayoutXYZ>;
  if (volume.type != VoxelType::kF32 || volume.slope != 1 || volume.intercept != 0 ||
      volume.spacing[0] != volume.spacing[1] || volume.spacing[0] != volume.spacing[2]) {
    return invalid_input("volume must hold f32 values with equal spacing for OpenVDB");
  }
  try {
    openvdb::initialize();
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    std::size_t(make_executor(threads)->thread_count()));
    const openvdb::CoordBBox box(
        openvdb::Coord(0),
        openvdb::Coord(volume.size[0] - 1, volume.size[1] - 1, volume.size[2] - 1));
    // A background that no voxel has: all of them become active.
    const auto fog = openvdb::FloatGrid::create(-3e38f);
    fog->setTransform(openvdb::math::Transform::createLinearTransform(volume.spacing[0]));
    openvdb::tools::copyFromDense(ConstDense(box, static_cast<const float*>(volume.data)), *fog,
                                  0.0f);
    const auto start = std::chrono::steady_clock::now();
    const auto sdf = openvdb::tools::fogToSdf(*fog, isovalue);
    *seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    Dense dense(box, distance.data);
    openvdb::tools::copyToDense(*sdf, dense);
  } catch (const std::exception& e) {
    return invalid_input(std::string("OpenVDB: ") + e.what());
  }
  return {};
}

#else

Status openvdb_distance(const VolumeView&, float, int, GridView<float>, double*) {
  return unsupported("this build has no OpenVDB");
}

#endif

}  // namespace obscura::tools
