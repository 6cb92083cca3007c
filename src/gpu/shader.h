#ifndef OBSCURA_SRC_GPU_SHADER_H_
#define OBSCURA_SRC_GPU_SHADER_H_

#include <cstdint>
#include <span>

#include "gpu/interface.h"

namespace obscura::gpu {

// SPIR-V of one shader; of those that store results (results.glsl) also a second form, whose
// results go to scratch memory. Empty: the shader stores none.
struct Shader {
  std::span<const std::uint32_t> words, to_scratch;
  const Interface* io;
};

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_GPU_SHADER_H_
