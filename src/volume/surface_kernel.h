#ifndef OBSCURA_SRC_VOLUME_SURFACE_KERNEL_H_
#define OBSCURA_SRC_VOLUME_SURFACE_KERNEL_H_

#include <cstddef>

#include "obscura/volume.h"

namespace obscura {

// Distance and scalar field in index space, where voxel (i, j, k) is the point (i, j, k).
struct SurfaceGrid {
  int size[3];
  float spacing[3];
  const float* distance;
  std::ptrdiff_t distance_stride[3];
  const void* samples;
  VoxelType type;
  std::ptrdiff_t stride[3];
  // scale * sample + offset is positive in matter and zero on the surface.
  float scale, offset;
};

// Rays as arrays of coordinates: origins and directions in index space, per unit of world length.
struct SurfaceRays {
  int count;
  float* origin[3];
  float* direction[3];
  // Results: world length to the hit, +inf for none; the unit normal in grid space; and whether the
  // ray began in matter, at the border or at its own start.
  float* hit;
  float* normal[3];
  float* began_inside;
};

// Room in every array for whole vectors: count rounded up to this.
inline constexpr int kSurfaceRayGroup = 16;

void trace_surface(const SurfaceGrid& grid, const SurfaceRays& rays);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_SURFACE_KERNEL_H_
