#include "obscura/simd.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>

#include "core/text.h"
#include "hwy/highway.h"
#include "hwy/targets.h"

namespace obscura {
namespace {

std::string name_of(std::int64_t target) {
  std::string name = hwy::TargetName(target);
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

// What the CPU supports of what is compiled, whatever the limit; a bit each, better targets
// are lower bits.
std::int64_t usable_targets() {
  static const std::int64_t targets = [] {
    hwy::DisableTargets(0);
    return hwy::SupportedTargets() & HWY_TARGETS;
  }();
  return targets;
}

std::string& limit() {
  static std::string name;
  return name;
}

}  // namespace

std::vector<std::string> simd_targets() {
  std::vector<std::string> names;
  for (std::int64_t left = usable_targets(); left != 0; left &= left - 1) {
    names.push_back(name_of(left & -left));
  }
  std::ranges::reverse(names);
  return names;
}

Status limit_simd(std::string_view best) {
  const std::int64_t usable = usable_targets();
  if (best.empty()) {
    hwy::DisableTargets(0);
    limit().clear();
    return {};
  }
  for (std::int64_t left = usable; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    if (name_of(target) != best) continue;
    hwy::DisableTargets(target - 1);  // every better one
    limit() = best;
    return {};
  }
  std::string names;
  for (const std::string& name : simd_targets()) names += (names.empty() ? "" : ", ") + name;
  return invalid_argument(
      text("the SIMD target is '", best, "'; this processor and build have ", names));
}

std::string simd_limit() { return limit(); }

Status limit_simd_from_environment() {
  const char* best = std::getenv("OBSCURA_SIMD");
  if (!best) return {};
  const Status s = limit_simd(best);
  return s.ok() ? s : invalid_argument("OBSCURA_SIMD: " + s.message());
}

}  // namespace obscura
