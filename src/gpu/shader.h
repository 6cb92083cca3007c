#ifndef OBSCURA_SRC_GPU_SHADER_H_
#define OBSCURA_SRC_GPU_SHADER_H_

#include <cstdint>
#include <span>

namespace obscura::vulkan {

// SPIR-V of one shader; of those that store results (results.glsl) also a second form, whose
// results go to scratch memory. Empty: the shader stores none.
struct Shader {
  std::span<const std::uint32_t> words, to_scratch;
};

}  // namespace obscura::vulkan

#endif  // OBSCURA_SRC_GPU_SHADER_H_
