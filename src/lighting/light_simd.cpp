#include <limits>

#include "lighting/light_kernel.h"
#include "lighting/preconvolve_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "lighting/light_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/contrib/math/math-inl.h"
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "math/cone_leaf.h"

// Words of the light's leaf file alone.
LEAF(Real) leaf_acos(Real x) { return hn::Acos(D(), x); }
#include "obscura/glsl/light_leaf.glsl"
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace lighting {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace leaf = obscura::HWY_NAMESPACE::leaf;
using D = hn::ScalableTag<float>;
using DI = hn::RebindToSigned<D>;
using D4 = hn::FixedTag<float, 4>;
using V = hn::Vec<D>;
using VI = hn::Vec<DI>;
constexpr int kMaxLanes = HWY_MAX_BYTES / sizeof(float);

using Vector = leaf::LightVector;

HWY_INLINE Vector LoadVector(const float* const planes[3], int x) {
  const D d;
  return {hn::LoadU(d, planes[0] + x), hn::LoadU(d, planes[1] + x), hn::LoadU(d, planes[2] + x)};
}

HWY_INLINE Vector ToWorld(const LightFrame& f, const Vector& v) {
  const D d;
  auto row = [&](int k) HWY_ATTR {
    const float* m = f.world_from_eye + 3 * k;
    return leaf::light_dot({hn::Set(d, m[0]), hn::Set(d, m[1]), hn::Set(d, m[2])}, v);
  };
  return {row(0), row(1), row(2)};
}

// Where a look-up finds its cell: the offset of its first vertex in the table and the weights of
// its four vertices.
struct Cells {
  HWY_ALIGN std::int32_t offset[kMaxLanes];
  HWY_ALIGN float weight[4][kMaxLanes];
};

HWY_INLINE void FindCells(const LightFrame& f, const Vector& w, V level, Cells* cells) {
  const D d;
  const DI di;
  const leaf::LightCell cell = leaf::light_cell(hn::Set(d, static_cast<float>(f.cells)), w);
  const VI vertex = hn::ConvertTo(di, cell.vertex), low = hn::ConvertTo(di, level);
  hn::Store(hn::Add(hn::Mul(vertex, hn::Set(di, kVertexFloats)), hn::ShiftLeft<2>(low)), di,
            cells->offset);
  const V one = hn::Set(d, 1.0f), u0 = hn::Sub(one, cell.u), v0 = hn::Sub(one, cell.v);
  hn::Store(hn::Mul(u0, v0), d, cells->weight[0]);
  hn::Store(hn::Mul(cell.u, v0), d, cells->weight[1]);
  hn::Store(hn::Mul(u0, cell.v), d, cells->weight[2]);
  hn::Store(hn::Mul(cell.u, cell.v), d, cells->weight[3]);
}

// Bilinear between a cell's vertices and, for cones, linear between two levels, pixel by pixel: a
// vertex' channels lie side by side, so one load fetches them all.
template <bool kCone>
HWY_INLINE Vector LookUp(const LightFrame& f, const Cells& cells, const float* between) {
  const D d;
  const D4 d4;
  const std::ptrdiff_t row = std::ptrdiff_t{kVertexFloats} * (f.cells + 1);
  const std::ptrdiff_t vertices[4] = {0, kVertexFloats, row, row + kVertexFloats};
  HWY_ALIGN float rgb[4 * kMaxLanes];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const float* base = f.table + cells.offset[lane];
    auto low = hn::Zero(d4);
    auto high = hn::Zero(d4);
    for (int k = 0; k < 4; ++k) {
      const auto w = hn::Set(d4, cells.weight[k][lane]);
      low = hn::MulAdd(w, hn::Load(d4, base + vertices[k]), low);
      if constexpr (kCone) high = hn::MulAdd(w, hn::Load(d4, base + vertices[k] + 4), high);
    }
    if constexpr (kCone) low = hn::MulAdd(hn::Set(d4, between[lane]), hn::Sub(high, low), low);
    hn::Store(low, d4, rgb + 4 * lane);
  }
  Vector out;
  V unused;
  hn::LoadInterleaved4(d, rgb, out.x, out.y, out.z, unused);
  return out;
}

template <LightingTechnique kTechnique>
HWY_INLINE Vector Pixels(const LightFrame& f, const LightRow& row, int at) {
  constexpr bool kCone = kTechnique == LightingTechnique::kBentCone;
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const V visibility = leaf::light_visibility(hn::LoadU(d, row.visibility + at));
  const Vector n = leaf::light_unit(LoadVector(row.normal, at), {zero, zero, one});
  Vector axis = n;
  if constexpr (kTechnique != LightingTechnique::kAmbientOcclusion) {
    axis = leaf::light_unit(LoadVector(row.bent, at), n);
  }

  Cells cells;
  V angle = hn::Set(d, leaf::kLightHalfPi), cosine = zero, low = hn::Set(d, kLevels - 1.0f);
  HWY_ALIGN float between[kMaxLanes];
  if constexpr (kCone) {
    angle = leaf::light_angle(hn::LoadU(d, row.angle + at));
    cosine = hn::Max(hn::Cos(d, angle), zero);
    const leaf::LightLevel level = leaf::light_level(angle);
    low = level.low;
    hn::Store(level.between, d, between);
  }
  FindCells(f, ToWorld(f, axis), low, &cells);
  Vector rgb = LookUp<kCone>(f, cells, between);

  const V bend = hn::Min(hn::Max(leaf::light_dot(axis, n), zero), one);
  const V scale =
      leaf::light_scale(f.geometric_term, kCone && f.paper_normalisation, visibility, bend, cosine);
  rgb = {hn::Mul(rgb.x, scale), hn::Mul(rgb.y, scale), hn::Mul(rgb.z, scale)};

  if (f.sun_shines) {
    const float* sun = f.sun.direction;
    const Vector s{hn::Set(d, sun[0]), hn::Set(d, sun[1]), hn::Set(d, sun[2])};
    const V along_axis = leaf::light_dot(axis, s);
    V w = hn::Mul(hn::Max(along_axis, zero), visibility);
    if constexpr (kCone) {
      w = hn::Mul(hn::Max(leaf::light_dot(n, s), zero),
                  leaf::light_sun_through_cone(f.uniform_weights, visibility, bend, angle, cosine,
                                               along_axis, hn::Set(d, f.sun.radius)));
    }
    const float* light = f.sun.rgb;
    rgb = {hn::MulAdd(w, hn::Set(d, light[0]), rgb.x), hn::MulAdd(w, hn::Set(d, light[1]), rgb.y),
           hn::MulAdd(w, hn::Set(d, light[2]), rgb.z)};
  }
  if (row.albedo[0]) {
    const Vector a = LoadVector(row.albedo, at);
    // Max takes its second operand where the first is NaN.
    rgb = {hn::Mul(rgb.x, hn::Max(a.x, zero)), hn::Mul(rgb.y, hn::Max(a.y, zero)),
           hn::Mul(rgb.z, hn::Max(a.z, zero))};
  }
  return rgb;
}

template <LightingTechnique kTechnique>
void Row(const LightFrame& f, const LightRow& row, int width) {
  const D d;
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const Vector rgb = Pixels<kTechnique>(f, row, x);
    hn::StoreU(rgb.x, d, row.out[0] + x);
    hn::StoreU(rgb.y, d, row.out[1] + x);
    hn::StoreU(rgb.z, d, row.out[2] + x);
  }
}

void LightPixels(const LightFrame& f, const LightRow& row, int width) {
  switch (f.technique) {
    case LightingTechnique::kAmbientOcclusion:
      return Row<LightingTechnique::kAmbientOcclusion>(f, row, width);
    case LightingTechnique::kBentNormal:
      return Row<LightingTechnique::kBentNormal>(f, row, width);
    case LightingTechnique::kBentCone:
      return Row<LightingTechnique::kBentCone>(f, row, width);
  }
}

void CosineCones(const float* visibility, const float* const integral[3], int width,
                 float* const direction[3], float* angle) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  for (int x = 0; x < width; x += static_cast<int>(hn::Lanes(d))) {
    const Vector v = LoadVector(integral, x);
    const V whole = hn::LoadU(d, visibility + x);
    const V length = hn::Sqrt(leaf::light_dot(v, v));
    const Vector unit = leaf::light_unit(v, {zero, zero, one});
    // The narrowest opening, a cone with nothing open, where nothing is visible.
    const V mean = hn::IfThenElse(hn::Gt(whole, zero), hn::Div(length, whole), one);
    const V cosine = leaf::cap_cosine_of_cosine_mean(mean);
    hn::StoreU(unit.x, d, direction[0] + x);
    hn::StoreU(unit.y, d, direction[1] + x);
    hn::StoreU(unit.z, d, direction[2] + x);
    hn::StoreU(hn::Acos(d, cosine), d, angle + x);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace lighting
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::lighting {

HWY_EXPORT(LightPixels);
HWY_EXPORT(CosineCones);

void light_row(const LightFrame& frame, const LightRow& row, int width) {
  HWY_DYNAMIC_DISPATCH(LightPixels)(frame, row, width);
}
void cosine_cone_row(const float* visibility, const float* const integral[3], int width,
                     float* const direction[3], float* angle) {
  HWY_DYNAMIC_DISPATCH(CosineCones)(visibility, integral, width, direction, angle);
}

}  // namespace obscura::lighting
#endif
