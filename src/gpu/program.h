#ifndef OBSCURA_SRC_GPU_PROGRAM_H_
#define OBSCURA_SRC_GPU_PROGRAM_H_

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/pass.h"

namespace obscura::gpu {

// A method as passes over regions of scratch memory, one after the other. Passes whose shader,
// constants and kinds of slots are equal share a pipeline.
struct Program {
  std::vector<std::uint64_t> regions;  // bytes
  std::vector<Pass> passes;
  std::vector<float> tables;  // uploaded once to `table_region`
  int table_region = -1;
  bool half = false;  // passes that are added work at half resolution

  int add_region(std::uint64_t bytes) {
    regions.push_back(bytes);
    return static_cast<int>(regions.size()) - 1;
  }
  // Appends to the tables; returns where, in floats.
  int add_table(std::span<const float> values);
  void add(Pass pass);
};

}  // namespace obscura::gpu

#endif  // OBSCURA_SRC_GPU_PROGRAM_H_
