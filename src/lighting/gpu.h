#ifndef OBSCURA_SRC_LIGHTING_GPU_H_
#define OBSCURA_SRC_LIGHTING_GPU_H_

#include <array>
#include <cstdint>

#include "gpu/program.h"
#include "obscura/frame_shape.h"
#include "obscura/lighting.h"

namespace obscura::gpu {

struct LightProgram {
  LightingSettings settings;
  FrameShape shape;
  bool albedo = false;
  int cells = 32;  // of the environment's table
};

// One pass, and region 0, the environment's table.
Status make_light_program(const LightProgram& light, Program* program);

using LightWords = std::array<std::uint32_t, kMaxPush>;

// The pass's push constants.
Status make_light_push(const std::array<float, 9>& world_from_eye, const Sun& sun,
                       LightWords* words);

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_LIGHTING_GPU_H_
