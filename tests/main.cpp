#include <gtest/gtest.h>

#include <cstdio>

#include "obscura/simd.h"

// OBSCURA_SIMD limits what kernels run with, as it does for the command.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (const obscura::Status s = obscura::limit_simd_from_environment(); !s.ok()) {
    std::fprintf(stderr, "%s\n", s.message().c_str());
    return 2;
  }
  return RUN_ALL_TESTS();
}
