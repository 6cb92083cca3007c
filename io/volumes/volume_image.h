#ifndef OBSCURA_IO_VOLUMES_VOLUME_IMAGE_H_
#define OBSCURA_IO_VOLUMES_VOLUME_IMAGE_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "obscura/volume.h"

namespace obscura::tools {

using Double3 = std::array<double, 3>;

// An owned volume with its place in the world.
//
// World convention: right-handed, in the file's own unit of length. NIfTI and NRRD files that name
// an anatomical space are in RAS: +x is the patient's right, +y anterior, +z superior (LPS and LAS
// are turned into it). Elsewhere the world is the file's own. `up` is the direction that a default
// view shows upwards: z, for OpenVDB y.
struct VolumeImage {
  std::string name;                  // file or specification, for messages
  std::vector<std::string> notes{};  // what was chosen on reading, a line each
  std::string format;                // "NIfTI", "NRRD", ...
  VoxelType type = VoxelType::kF32;
  std::string stored_type = "f32";   // in the file; what VoxelType does not have becomes f32
  std::array<int, 3> size{};         // x runs fastest
  std::vector<std::byte> samples{};  // dense
  float slope = 1, intercept = 0;
  // World position of voxel (i, j, k): origin + i axes[0] + j axes[1] + k axes[2].
  std::array<Double3, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Double3 origin{};
  Double3 up{0, 0, 1};
  // What the source itself says of its surface: level sets and procedural volumes.
  std::optional<float> isovalue{};
  std::optional<SolidSide> solid{};

  Double3 spacing() const;  // world length of one voxel step along each axis
  std::int64_t voxels() const { return std::int64_t{1} * size[0] * size[1] * size[2]; }
  VolumeView view() const;

  // Between the world and the library's grid space (lengths stay, axes turn or flip).
  Double3 to_grid(const Double3& world) const;
  Double3 direction_to_grid(const Double3& world) const;
  Double3 to_world(const Double3& grid) const;
};

std::size_t bytes_of(VoxelType type);

// Sides of [1, 8192] voxels; axes that are finite, of usable length and at right angles.
Status check_geometry(const VolumeImage& image);

// A box of voxels, both ends of each range included: "x0:x1,y0:y1,z0:z1"; an end left out is the
// volume's ("10:,:99,:" is whole along z).
struct ClipBox {
  std::array<int, 3> first{0, 0, 0}, last{-1, -1, -1};  // last under 0: the volume's end
};
Status parse_clip(const std::string& text, ClipBox* box);

// Keeps the voxels of the box; the kept ones stay where they were in the world.
Status clip(const ClipBox& box, VolumeImage* image);

}  // namespace obscura::tools

#endif  // OBSCURA_IO_VOLUMES_VOLUME_IMAGE_H_
