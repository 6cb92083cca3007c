#ifndef OBSCURA_SRC_VOLUME_DISTANCE_KERNEL_H_
#define OBSCURA_SRC_VOLUME_DISTANCE_KERNEL_H_

#include <cstddef>
#include <vector>

namespace obscura {

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
class DistanceStage {
 public:
  // Spacing along x, y and z.
  DistanceStage(int width, int height, const float spacing[3], bool mirrored);

  // Forgets the previous plane: the next plane is the first of its direction along z.
  void begin_pass() { first_ = true; }

  // Updates the magnitudes of one plane and keeps its signs. Strides are in floats.
  void sweep(float* plane, std::ptrdiff_t stride_x, std::ptrdiff_t stride_y);

  // Whether any magnitude fell since the last call.
  bool take_changed();

 private:
  int width_, height_;
  float spacing_[3];
  bool mirrored_;
  bool first_ = true;
  bool changed_ = false;
  int lanes_, strips_, steps_;
  std::ptrdiff_t row_pitch_;
  std::vector<float> storage_;
  float *plane_, *before_, *rows_;  // skewed, this plane and the one before; one strip's rows
};

}  // namespace obscura

#endif  // OBSCURA_SRC_VOLUME_DISTANCE_KERNEL_H_
