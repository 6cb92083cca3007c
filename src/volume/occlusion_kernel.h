#ifndef OBSCURA_SRC_VOLUME_OCCLUSION_KERNEL_H_
#define OBSCURA_SRC_VOLUME_OCCLUSION_KERNEL_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "obscura/executor.h"

namespace obscura {

// How a direction's visibility comes from the voxels before it.
enum class Stencil {
  kUpwind,          // mean of three neighbours (equation 6, any weights)
  kCharacteristic,  // bilinear on the face of the cell that the direction's ray comes through
};

// A direction of the first octant, in the grid's index space, and what its stencil needs.
struct SweepDirection {
  std::array<float, 3> direction{};  // unit, in world space
  float weight = 0;                  // of the octant's mean; they sum to 1
  Stencil stencil = Stencil::kUpwind;
  int axis = 0;      // kCharacteristic: axis across which the ray comes
  float first = 0;   // kUpwind: weights of the x and y neighbours; kCharacteristic: shift of the
  float second = 0;  // ray on the face along the other two axes, in rising order, in [0, 1]
};

inline constexpr int kMaxDirections = 10;

// Sweeps the four octants with light from one side of z through a grid of transmittances.
struct OcclusionSweep {
  const std::uint8_t* tau = nullptr;  // dense, x fastest; 255 is open
  std::array<int, 3> size{};
  bool rising = true;  // z rises along the light: it comes from the negative side
  const SweepDirection* directions = nullptr;
  int count = 0;  // of directions, 1 ... kMaxDirections
  // Visibility at each voxel, 255 is open: channel slot * count + direction.
  std::uint8_t* visibility = nullptr;
  // W = V tau of the plane before the first, and of the last; null: open, or not wanted. A fraction
  // of 32767 for each direction, quadrant, y and x, the last fastest.
  const std::int16_t* upwind = nullptr;
  std::int16_t* downwind = nullptr;
};

// Bit 0 or 1 of a quadrant is set for light from the positive side of x or y. Quadrants that the
// sweep holds mirrored in x come last.
inline constexpr int kQuadrantOfSlot[4] = {0, 3, 1, 2};
inline constexpr int kSlotOfQuadrant[4] = {0, 2, 3, 1};

// Sweeps of one size of grid on several threads. Each thread takes the next plane along z and
// follows the plane before it: direction by direction, two strips of rows behind, so that a strip
// finds its own of the plane before, and overwrites no values that are still read. The values do
// not depend on who computes them, nor when: the bits are those of one thread.
class OcclusionPipeline {
 public:
  // Takes all memory. `workers`: most threads at the same time.
  OcclusionPipeline(std::span<const OcclusionSweep> sweeps, int workers);
  ~OcclusionPipeline();

  // More workers than this would only wait.
  static int most_workers(const OcclusionSweep& sweep);

  // Sweeps planes until all are taken or `done`, called after each, says false. Called once for
  // each worker in [0, workers), at the same time or one after another.
  void work(int worker, FunctionRef<bool()> done);
  // Writes the sweeps' downwind planes, once all workers are done.
  void finish();

  // Strips of the whole sweep, each of one direction or of those swept together, and those of the
  // longest chain in which each must wait for the one before.
  struct Count {
    std::int64_t work = 0, span = 0;
  };
  Count count() const;

 private:
  struct Half;
  struct Scratch;
  std::vector<std::unique_ptr<Half>> halves_;
  std::vector<Scratch> scratch_;
};

// One sweep in the calling thread.
void sweep_occlusion_u8(const OcclusionSweep& sweep);

// The same in floats by plain loops, with one quadrant and direction per call; `visibility` is that
// channel, `step` floats from voxel to voxel.
void sweep_occlusion_f32(const float* tau, const std::array<int, 3>& size,
                         const std::array<bool, 3>& from_positive, const SweepDirection& direction,
                         float* visibility, std::ptrdiff_t step);

// tau of a row of coarse voxels from the sum of the distances in each: 255 clamp(sum s + 1/2), and
// its opacity times alpha (equations 7 and 8). `rows` are rows of distances, `cell` along x.
void transmittance_row(const float* const* rows, int row_count, std::ptrdiff_t stride, int width,
                       int cell, float scale, float alpha, std::uint8_t* tau);

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_OCCLUSION_KERNEL_H_
