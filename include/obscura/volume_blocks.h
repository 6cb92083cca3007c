#ifndef OBSCURA_VOLUME_BLOCKS_H_
#define OBSCURA_VOLUME_BLOCKS_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "obscura/volume.h"

// Volumes in slabs: blocks of whole planes along z, each swept by itself from the plane before it,
// its upwind face, to its last plane, the next block's face. For volumes that are larger than
// memory, or that several machines hold together: the caller carries faces from block to block by
// any transport. The bits are those of sweep_distance and sweep_occlusion for any slabs.
//
// A face holds no padding and is the same for every SIMD target.

namespace obscura {

// Whether a surface at the isovalue cuts a volume whose values lie in this range; else an error
// that says so. A block alone does not know: its volume's range is the union of the blocks'.
OBSCURA_API Status check_isovalue(const VolumeRange& range, const DistanceSettings& settings);

// What sweep_distance does first, for one block: distances of the voxels beside the surface, and
// far ones of the right sign elsewhere.
//
// Requires: `samples` holds the block's planes and, where the volume goes on, one more: below it
// (toward smaller z) if `below`, above it if `above`. `distance` holds the block's planes.
OBSCURA_API Status start_distance_block(const VolumeView& samples, bool below, bool above,
                                        const DistanceSettings& settings, GridView<float> distance,
                                        const RunOptions& run = {});

// Floats of a face of the distance sweep for planes of this size: two planes.
constexpr std::size_t distance_face_size(int width, int height) {
  return 2 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

// One pass of the distance sweep through a block, toward greater z if `rising`. A round is a rising
// pass through all blocks from the lowest to the highest, then a falling one from the highest to
// the lowest; it is 8 of DistanceSettings' sweeps.
//
// `upwind`: the downwind face of the block before in the pass's direction; empty for the first.
// `downwind`: written; empty if not wanted. Both in world units, distance_face_size() floats; they
// may be the same memory. `changed`, unless null: whether any distance fell.
// Requires: spacing of `distance` is the volume's.
OBSCURA_API Status sweep_distance_block(GridView<float> distance, bool rising,
                                        std::span<const float> upwind, std::span<float> downwind,
                                        bool* changed = nullptr, const RunOptions& run = {});

// Planes of the turned grid that sweep_shadow uses for a volume.
OBSCURA_API Status shadow_planes(const std::array<int, 3>& size,
                                 const std::array<float, 3>& spacing, std::array<float, 3> to_light,
                                 const OcclusionSettings& settings, int* planes);

// Voxels of the volume along a side of a voxel of the field: blocks but the last must have a
// multiple of it as planes.
constexpr int field_cell(Transport transport) { return transport == Transport::kPaper ? 1 : 2; }

class OcclusionBlockImpl;

// The occlusion sweep through one block. Each half of the octants is a sweep of its own: light from
// below rises through the blocks, light from above falls.
class OBSCURA_API OcclusionBlock {
 public:
  OcclusionBlock();
  ~OcclusionBlock();
  OcclusionBlock(OcclusionBlock&&) noexcept;
  OcclusionBlock& operator=(OcclusionBlock&&) noexcept;

  // Takes the block's transmittances from its finished distances; every block but the last has a
  // multiple of field_cell() as planes. Refuses VisibilityPrecision::kF32.
  Status start(GridView<const float> distance, const OcclusionSettings& settings,
               const RunOptions& run = {});

  // In place of start, for sweep_shadow's single octant: planes `begin` to `end` of its turned grid
  // around a whole volume of this size and spacing. It is open until shade() has been called for
  // every block of distances. Light falls through this grid: only sweep(false, ...) counts, and
  // field().octant(7).
  Status start_shadow(const std::array<int, 3>& size, const std::array<float, 3>& spacing,
                      std::array<float, 3> to_light, const OcclusionSettings& settings, int begin,
                      int end);
  // Transmittances where a block of distances lies: `distance` holds planes of the volume from
  // `first` on, one more than the block's where the volume goes on above it.
  Status shade(GridView<const float> distance, int first, const RunOptions& run = {});
  // Of a block of a shadow, 255 is open. Blocks that several processes have shaded, each with its
  // own distances, make one by the least of their values.
  std::span<std::uint8_t> transmittance();

  std::size_t face_size() const;  // numbers of a face: 4 to 40 for each voxel of a plane

  // Sweeps one half; `upwind` and `downwind` as for sweep_distance_block.
  Status sweep(bool rising, std::span<const std::int16_t> upwind, std::span<std::int16_t> downwind,
               const RunOptions& run = {});

  // Visibilities of a half, to be kept and brought back. Empty before its sweep.
  std::span<const std::uint8_t> half(bool rising) const;
  // Takes the place of a sweep: `fill` writes what half() gave for this block.
  Status restore(bool rising, FunctionRef<Status(std::span<std::uint8_t>)> fill);

  // The octants that have been swept, and their mean once both halves have: planes of the whole
  // field. Its light() knows no other block, so that points must lie within and beside this one.
  const VisibilityField& field() const;

 private:
  std::unique_ptr<OcclusionBlockImpl> impl_;
};

}  // namespace obscura

#endif  // OBSCURA_VOLUME_BLOCKS_H_
