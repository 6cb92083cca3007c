#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_FINISH_KERNEL_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_FINISH_KERNEL_H_

namespace obscura::far_field {

// Part of a row of totals, to directions. Rows are read up to a vector beyond `count`.
struct FinishJob {
  static constexpr int kMaxCount = 256, kRoom = kMaxCount + 16;  // and a vector more
  int count = 0;
  bool paper_cone = false;
  const float* vector[3] = {};  // sums of (1 - V) w
  const float* solid = nullptr;
  const float* normal[3] = {};
  float integral[3][kRoom], direction[3][kRoom], angle[kRoom];  // results
};
void finish_directions(FinishJob* job);

// A row's sums along the view ray (a, b, 1), a = first_a + x step_a, go to the three axes: added to
// x and y, stored to z, which may be `ray` itself.
struct RayJob {
  int width;
  float first_a, step_a, b;
  const float* ray;
  float *x, *y, *z;
};
void add_ray(const RayJob& job);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_FINISH_KERNEL_H_
