#ifndef OBSCURA_SRC_GPU_RHO_WORDS_H_
#define OBSCURA_SRC_GPU_RHO_WORDS_H_

// The first push constants of shaders that evaluate the falloff: members of math::Rho.
#define OBSCURA_RHO_WORDS   \
  float rho_radius;         \
  float inverse_radius;     \
  float entries_per_length; \
  int last_entry;

#endif  // OBSCURA_SRC_GPU_RHO_WORDS_H_
