#include "lighting/preconvolve_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lighting/preconvolve_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace lighting {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, kConvolutionGroup>;
using V = hn::Vec<D>;

// Levels summed in one pass over the sources: four sums each must stay in registers.
constexpr int kPerPass = HWY_TARGET <= HWY_AVX3 ? 4 : 2;

// Lanes are output directions, so that each is summed in the same order whatever the vector length.
void ConvolvePass(const Convolution& c, int first, V x, V y, V z, int count,
                  float* HWY_RESTRICT out) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  V red[kPerPass], green[kPerPass], blue[kPerPass], whole[kPerPass];
  for (int k = 0; k < kPerPass; ++k) red[k] = green[k] = blue[k] = whole[k] = zero;
  for (std::size_t i = 0; i < c.count; ++i) {
    const ConvolutionSource& s = c.sources[i];
    const V cosine = hn::Max(
        hn::MulAdd(x, hn::Set(d, s.x), hn::MulAdd(y, hn::Set(d, s.y), hn::Mul(z, hn::Set(d, s.z)))),
        zero);
    const V r = hn::Set(d, s.r), g = hn::Set(d, s.g), b = hn::Set(d, s.b);
    const V solid_angle = hn::Set(d, s.solid_angle);
    for (int k = 0; k < kPerPass; ++k) {
      const ConvolutionLevel& level = c.levels[first + k];
      const V edge = hn::MulAdd(cosine, hn::Set(d, level.slope), hn::Set(d, level.offset));
      const V w = hn::Mul(hn::Min(hn::Max(edge, zero), one), cosine);
      red[k] = hn::MulAdd(w, r, red[k]);
      green[k] = hn::MulAdd(w, g, green[k]);
      blue[k] = hn::MulAdd(w, b, blue[k]);
      whole[k] = hn::MulAdd(w, solid_angle, whole[k]);
    }
  }
  for (int k = 0; k < kPerPass; ++k) {
    // Divided by the sum of the weights rather than pi sin^2(a), so that constant light stays
    // exactly constant.
    const V scale = hn::Div(one, whole[k]);
    HWY_ALIGN float rgb[3][kConvolutionGroup];
    hn::Store(hn::Mul(red[k], scale), d, rgb[0]);
    hn::Store(hn::Mul(green[k], scale), d, rgb[1]);
    hn::Store(hn::Mul(blue[k], scale), d, rgb[2]);
    for (int lane = 0; lane < count; ++lane) {
      float* texel = out + lane * kVertexFloats + 4 * (first + k);
      for (int channel = 0; channel < 3; ++channel) texel[channel] = rgb[channel][lane];
      texel[3] = 0;
    }
  }
}

void Convolve(const Convolution& c, const float* x, const float* y, const float* z, int count,
              float* out) {
  const D d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < count; i += lanes) {
    const V vx = hn::LoadU(d, x + i), vy = hn::LoadU(d, y + i), vz = hn::LoadU(d, z + i);
    for (int first = 0; first < kLevels; first += kPerPass) {
      ConvolvePass(c, first, vx, vy, vz, count - i < lanes ? count - i : lanes,
                   out + i * kVertexFloats);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lighting
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::lighting {

HWY_EXPORT(Convolve);

void convolve(const Convolution& c, const float* x, const float* y, const float* z, int count,
              float* out) {
  HWY_DYNAMIC_DISPATCH(Convolve)(c, x, y, z, count, out);
}

}  // namespace obscura::lighting
#endif
