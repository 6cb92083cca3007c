#ifndef OBSCURA_VERSION_H_
#define OBSCURA_VERSION_H_

#include "obscura/export.h"

// The version of these headers. docs/compatibility.md says what may change between versions.
#define OBSCURA_VERSION_MAJOR 0
#define OBSCURA_VERSION_MINOR 1
#define OBSCURA_VERSION_PATCH 0

// One number to compare: #if OBSCURA_VERSION >= OBSCURA_MAKE_VERSION(0, 2, 0)
#define OBSCURA_MAKE_VERSION(major, minor, patch) ((major)*1000000 + (minor)*1000 + (patch))
#define OBSCURA_VERSION \
  OBSCURA_MAKE_VERSION(OBSCURA_VERSION_MAJOR, OBSCURA_VERSION_MINOR, OBSCURA_VERSION_PATCH)

namespace obscura {

// The version of the library, "major.minor.patch"; another than the headers' if an application was
// compiled with one and runs with the other.
OBSCURA_API const char* version();

// The instruction set that kernels run with on this processor, e.g. "AVX3" (AVX-512) or "SSE4".
OBSCURA_API const char* simd_target();

// The compiler that built the library.
OBSCURA_API const char* compiler();

}  // namespace obscura

#endif  // OBSCURA_VERSION_H_
