// Part of every test program: OBSCURA_SIMD limits what kernels run with, as it does for the
// command.
#include <cstdio>
#include <cstdlib>

#include "obscura/simd.h"

namespace {

const bool limited = [] {
  const obscura::Status s = obscura::limit_simd_from_environment();
  if (s.ok()) return true;
  std::fprintf(stderr, "%s\n", s.message().c_str());
  std::exit(2);
}();

}  // namespace
