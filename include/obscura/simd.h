#ifndef OBSCURA_SIMD_H_
#define OBSCURA_SIMD_H_

#include <string>
#include <string_view>
#include <vector>

#include "obscura/export.h"
#include "obscura/status.h"

// The instruction sets (SIMD targets) that kernels run with. Each kernel is compiled for several
// and the best that the CPU has is chosen when it first runs.

namespace obscura {

// Names of the targets that this library has kernels for and this processor supports, slowest
// first: "sse4", "avx2", "avx3" (AVX-512); "neon" on ARM. Limits do not change it.
OBSCURA_API std::vector<std::string> simd_targets();

// From now on kernels use no faster target than `best`, one of simd_targets(), for the whole
// process; "" lifts the limit. For tests and measurements: results differ in the last bits only.
// Not to be called while anything of this library runs on another thread.
OBSCURA_API Status limit_simd(std::string_view best);

// What limit_simd was last given; "" where there is no limit.
OBSCURA_API std::string simd_limit();

// limit_simd with what the environment variable OBSCURA_SIMD says, if it is set. The library itself
// reads no environment: a program calls this where it wants the variable to count.
OBSCURA_API Status limit_simd_from_environment();

}  // namespace obscura

#endif  // OBSCURA_SIMD_H_
