#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "obscura/lighting.h"
#include "tests/fuzz/bytes.h"

using namespace obscura;

namespace {

// A few texels of light, made once: the fuzzer's bytes are for light(). A sky would take the
// sanitizers ten seconds.
const PreconvolvedEnvironment& environment() {
  static const PreconvolvedEnvironment made = [] {
    Environment sky;
    PreconvolvedEnvironment result;
    std::vector<float> texels;
    for (int i = 0; i < 3 * 8 * 4; ++i) texels.push_back(static_cast<float>(i % 7));
    const auto rgb = VectorView<const float>::interleaved(texels.data(), 8, 4);
    if (!Environment::from_lat_long(rgb, &sky).ok()) std::abort();
    if (!PreconvolvedEnvironment::make(sky, {.cells = 4, .source_cells = 8}, &result).ok()) {
      std::abort();
    }
    return result;
  }();
  return made;
}

}  // namespace

// Any images and settings: refused, or light that is finite and not negative, and the same on one
// thread and two.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes(data, size);
  LightingSettings settings;
  settings.technique = static_cast<LightingTechnique>(bytes.below(kEnumCount<LightingTechnique>));
  settings.normalisation =
      static_cast<ConeNormalisation>(bytes.below(kEnumCount<ConeNormalisation>));
  settings.weights = static_cast<VisibilityWeights>(bytes.below(kEnumCount<VisibilityWeights>));
  settings.geometric_term = bytes.flag();
  if (bytes.flag()) settings.world_from_eye[std::size_t(bytes.below(9))] = bytes.number();
  const int w = 1 + bytes.below(8), h = 1 + bytes.below(8);
  const auto pixels = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  auto numbers = [&](std::size_t channels) {
    std::vector<float> values(channels * pixels);
    for (float& v : values) v = bytes.number();
    return values;
  };
  const std::vector<float> visibility = numbers(1), cone = numbers(1);
  const std::vector<float> normal = numbers(3), bent = numbers(3);
  const LightingInputs in{.visibility = {visibility.data(), w, h},
                          .normal = VectorView<const float>::interleaved(normal.data(), w, h),
                          .bent_normal = VectorView<const float>::interleaved(bent.data(), w, h),
                          .cone_angle = {cone.data(), w, h}};
  std::vector<float> first(3 * pixels, -3), second = first;
  auto run = [&](std::vector<float>* out, int threads) {
    return light(in, environment(), settings, VectorView<float>::interleaved(out->data(), w, h),
                 {.threads = threads});
  };
  const Status s = run(&first, 1);
  if (!s.ok() && s.message().empty()) std::abort();
  for (float v : first) {
    if (s.ok() ? !(std::isfinite(v) && v >= 0) : v != -3) std::abort();
  }
  if (s.ok() && (!run(&second, 2).ok() || first != second)) std::abort();
  return 0;
}
