#include "obscura/version.h"

#include "hwy/highway.h"
#include "hwy/targets.h"

namespace obscura {

const char* version() { return OBSCURA_VERSION; }

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
