#ifndef OBSCURA_VERSION_H_
#define OBSCURA_VERSION_H_

namespace obscura {

// The library's version, "major.minor.patch".
const char* version();

// The instruction set that kernels run with on this processor, e.g. "AVX3" (AVX-512) or "SSE4".
const char* simd_target();

// The compiler that built the library.
const char* compiler();

}  // namespace obscura

#endif  // OBSCURA_VERSION_H_
