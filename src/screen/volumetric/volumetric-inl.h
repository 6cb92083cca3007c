// What the kernels of line and area sampling have in common; included once per SIMD target.
#if defined(OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_INL_H_
#undef OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_INL_H_
#else
#define OBSCURA_SRC_SCREEN_VOLUMETRIC_VOLUMETRIC_INL_H_
#endif

#include "hwy/highway.h"
#include "math/leaf-inl.h"
#include "view/taps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace volumetric {

using namespace taps;

// Integral of rho along sample i's line from the sphere's middle to depth offset z, |z| <= zs.
struct ConstantRho {
  static constexpr bool kQuadratic = false;
  template <class Frame>
  HWY_INLINE ConstantRho(const Frame&, int) {}
  HWY_INLINE V operator()(V z) const { return z; }
};
struct QuadraticRho {
  static constexpr bool kQuadratic = true;
  template <class Frame>
  HWY_INLINE QuadraticRho(const Frame& f, int i) : lateral(hn::Set(D(), f.lateral[i])) {}
  HWY_INLINE V operator()(V z) const { return leaf::quadratic_line(z, lateral); }
  V lateral;
};

// A kernel is made of a frame, finds the taps of vector v of a block from its receivers, normals
// and random directions, then sums them up: Find(r, n, noise, v), Sum(z, v).
template <class Kernel, bool kNormals, bool kRotate, class Frame>
void KernelRow(const Frame& f, int row, int begin, int end, float* HWY_RESTRICT out) {
  const RowLoader loader(f.view, row, end);
  const V zero = hn::Zero(D());
  Kernel kernel(f);
  auto find = [&](int i, int v) HWY_ATTR {
    Vec3 n = {zero, zero, zero}, noise = n;
    if constexpr (kNormals) n = loader.Normal(i);
    if constexpr (kRotate) noise = loader.Noise<false>(i);
    kernel.Find(Receivers(f.view, f.view.left + i, loader.y, loader.Depth(i)), n, noise, v);
  };
  auto sum = [&](int i, int v) HWY_ATTR {
    const V z = loader.Depth(i);
    loader.Store(kernel.Sum(z, v), z, i, out + (i - begin));
  };
  ForBlocks(begin, end, find, sum);
}

// The row by the kernel for this frame's normals, rotation, thickness and rho.
template <template <bool kNormals, bool kRotate, bool kThickness, class Rho> class Kernel,
          class Frame>
void Row(const Frame& f, int row, int begin, int end, float* out) {
  auto run = [&]<bool kNormals, bool kRotate, bool kThickness>() {
    if (f.quadratic) {
      using K = Kernel<kNormals, kRotate, kThickness, QuadraticRho>;
      KernelRow<K, kNormals, kRotate>(f, row, begin, end, out);
    } else {
      using K = Kernel<kNormals, kRotate, kThickness, ConstantRho>;
      KernelRow<K, kNormals, kRotate>(f, row, begin, end, out);
    }
  };
  auto thickness = [&]<bool kNormals, bool kRotate>() {
    f.thickness > 0 ? run.template operator()<kNormals, kRotate, true>()
                    : run.template operator()<kNormals, kRotate, false>();
  };
  auto rotate = [&]<bool kNormals>() {
    f.view.noise_x ? thickness.template operator()<kNormals, true>()
                   : thickness.template operator()<kNormals, false>();
  };
  f.view.normal_x ? rotate.template operator()<true>() : rotate.template operator()<false>();
}

}  // namespace volumetric
}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
