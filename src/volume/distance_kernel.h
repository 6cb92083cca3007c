#ifndef OBSCURA_SRC_VOLUME_DISTANCE_KERNEL_H_
#define OBSCURA_SRC_VOLUME_DISTANCE_KERNEL_H_

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/wait_count.h"

namespace obscura {

struct DistancePlane;

// Magnitudes during the sweeps. No distance in a grid reaches 1e30 world units. Voxels outside the
// grid hold kOutsideDistance; they are never updated, and no update comes from them.
inline constexpr float kUnknownDistance = 1e30f;
inline constexpr float kOutsideDistance = 3e38f;

// Sweeps plane after plane in two of the four orders within a plane: x and y both rising, then both
// falling; or, if `mirrored`, one rising and the other falling.
//
// The plane is stored skewed: a strip has as many rows as a vector has lanes, and vector t of a
// strip holds x = t - j in lane j. The neighbours of a voxel that come earlier in x and y then lie
// in the vector before, so a strip is swept vector by vector.
//
// Strips are swept in groups. Through a plane, groups go forward and then backward, each a little
// behind the group before it; several threads may sweep groups at the same time, with the same
// bits.
class DistanceStage {
 public:
  // Spacing along x, y and z. `workers`: most threads at the same time.
  DistanceStage(int width, int height, const float spacing[3], bool mirrored, int workers = 1);

  // The next plane is the first of its direction along z. `face`, unless null: magnitudes of the
  // plane before it as this stage left them, dense; null: it is outside the grid.
  void begin_pass(const float* face = nullptr);
  // Writes the magnitudes of the last of so many planes, the face of a pass that goes on from here.
  void end_pass(int planes, float* face) const;

  // Updates the magnitudes of the next plane and keeps its signs, in this thread. Strides are in
  // floats.
  void sweep(float* plane, std::ptrdiff_t stride_x, std::ptrdiff_t stride_y);

  // The same in parts. Those of plane k (counted from begin_pass) are the groups forward, from 0
  // on, then backward, from the last on. A part waits for the parts before it, which must have been
  // begun, by any thread. Worker in [0, workers), one thread at a time.
  struct Plane {
    float* data;
    std::ptrdiff_t stride_x, stride_y;
  };
  int groups() const { return groups_; }
  static int groups_of(int height);
  void sweep_group(const Plane& plane, int k, bool forward, int group, int worker);
  // Waits until `ahead` has written the group's rows of plane k.
  void follow(const DistanceStage& ahead, int k, int group) const;

  // Whether any magnitude fell since the last call.
  bool take_changed();

  // Vectors of one pass of two such stages along z, and those of the longest chain in which each
  // must wait for the one before.
  struct Count {
    std::int64_t work = 0, span = 0;
  };
  Count count(int depth) const;

 private:
  // Plane k as the kernel sees it.
  DistancePlane view(const Plane& plane, int k, int worker) const;

  int width_, height_;
  float spacing_[3];
  bool mirrored_;
  std::atomic<bool> changed_{false};
  int lanes_, strips_, steps_, groups_, span_, next_ = 0;
  std::ptrdiff_t row_pitch_, rows_size_;
  std::vector<float> storage_;
  float* planes_[2];                           // skewed: plane k and the one before it
  float* rows_;                                // one strip's rows, for each worker
  std::vector<WaitCount> forward_, backward_;  // steps of each group, span_ a plane
};

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_DISTANCE_KERNEL_H_
