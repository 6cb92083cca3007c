#include "obscura/version.h"

#include "hwy/highway.h"
#include "hwy/targets.h"

namespace obscura {

#define OBSCURA_TEXT_OF(x) #x
#define OBSCURA_DOTTED(a, b, c) OBSCURA_TEXT_OF(a) "." OBSCURA_TEXT_OF(b) "." OBSCURA_TEXT_OF(c)

const char* version() {
  return OBSCURA_DOTTED(OBSCURA_VERSION_MAJOR, OBSCURA_VERSION_MINOR, OBSCURA_VERSION_PATCH);
}

const char* simd_target() {
  // Lower bits are better targets; only those compiled in can be chosen.
  const auto usable = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(usable & (~usable + 1));
}

const char* compiler() {
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

}  // namespace obscura
