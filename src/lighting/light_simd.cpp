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
constexpr float kHalfPi = 1.57079632679f;

struct Vector {
  V x, y, z;
};

HWY_INLINE V Dot(const Vector& a, const Vector& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE V Clamp01(V v) {
  const D d;
  return hn::Min(hn::Max(v, hn::Zero(d)), hn::Set(d, 1.0f));
}

HWY_INLINE Vector LoadVector(const float* const planes[3], int x) {
  const D d;
  return {hn::LoadU(d, planes[0] + x), hn::LoadU(d, planes[1] + x), hn::LoadU(d, planes[2] + x)};
}

// v / |v|, or `other` where v is zero or not finite.
HWY_INLINE Vector Unit(const Vector& v, const Vector& other) {
  const D d;
  const V one = hn::Set(d, 1.0f);
  // Divided by the largest component first, for squares of large ones overflow.
  const V largest = hn::Max(hn::Abs(v.x), hn::Max(hn::Abs(v.y), hn::Abs(v.z)));
  const V scale = hn::Div(one, largest);
  const Vector s{hn::Mul(v.x, scale), hn::Mul(v.y, scale), hn::Mul(v.z, scale)};
  const V square = Dot(s, s);
  // A NaN or an infinity anywhere makes the square not finite; a good one is in [1, 3].
  const auto good = hn::And(hn::Ge(square, hn::Set(d, 0.5f)), hn::Le(square, hn::Set(d, 3.5f)));
  const V inverse = hn::Div(one, hn::Sqrt(square));
  return {hn::IfThenElse(good, hn::Mul(s.x, inverse), other.x),
          hn::IfThenElse(good, hn::Mul(s.y, inverse), other.y),
          hn::IfThenElse(good, hn::Mul(s.z, inverse), other.z)};
}

HWY_INLINE Vector ToWorld(const LightFrame& f, const Vector& v) {
  const D d;
  auto row = [&](int k) HWY_ATTR {
    const float* m = f.world_from_eye + 3 * k;
    return Dot({hn::Set(d, m[0]), hn::Set(d, m[1]), hn::Set(d, m[2])}, v);
  };
  return {row(0), row(1), row(2)};
}

// Where a look-up finds its cell: the offset of its first vertex in the table and the weights of
// its four vertices.
struct Cells {
  HWY_ALIGN std::int32_t offset[kMaxLanes];
  HWY_ALIGN float weight[4][kMaxLanes];
};

// As CubeGrid::hit.
HWY_INLINE void FindCells(const LightFrame& f, const Vector& w, VI level, Cells* cells) {
  const D d;
  const DI di;
  const V ax = hn::Abs(w.x), ay = hn::Abs(w.y), az = hn::Abs(w.z);
  const auto is_x = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
  const auto is_y = hn::Ge(ay, az);
  auto choose = [&](V on_x, V on_y, V on_z) HWY_ATTR {
    return hn::IfThenElse(is_x, on_x, hn::IfThenElse(is_y, on_y, on_z));
  };
  const V major = choose(w.x, w.y, w.z);
  const V scale = hn::Div(hn::Set(d, 0.5f), hn::Abs(major));
  const V count = hn::Set(d, static_cast<float>(f.cells)), half = hn::Set(d, 0.5f);
  const V one = hn::Set(d, 1.0f);
  const VI last = hn::Set(di, f.cells - 1), side = hn::Set(di, f.cells + 1);
  auto cell = [&](V component, V* fraction) HWY_ATTR {
    const V at = hn::Mul(hn::MulAdd(component, scale, half), count);
    const VI i = hn::Max(hn::Min(hn::ConvertTo(di, at), last), hn::Zero(di));
    *fraction = Clamp01(hn::Sub(at, hn::ConvertTo(d, i)));
    return i;
  };
  V u, v;
  const VI i = cell(choose(w.y, w.z, w.x), &u), j = cell(choose(w.z, w.x, w.y), &v);
  const V axis = choose(hn::Zero(d), hn::Set(d, 2.0f), hn::Set(d, 4.0f));
  const VI face =
      hn::ConvertTo(di, hn::Add(axis, hn::IfThenElseZero(hn::Lt(major, hn::Zero(d)), one)));
  const VI vertex = hn::Add(hn::Mul(hn::Add(hn::Mul(face, side), j), side), i);
  hn::Store(hn::Add(hn::Mul(vertex, hn::Set(di, kVertexFloats)), hn::ShiftLeft<2>(level)), di,
            cells->offset);
  const V u0 = hn::Sub(one, u), v0 = hn::Sub(one, v);
  hn::Store(hn::Mul(u0, v0), d, cells->weight[0]);
  hn::Store(hn::Mul(u, v0), d, cells->weight[1]);
  hn::Store(hn::Mul(u0, v), d, cells->weight[2]);
  hn::Store(hn::Mul(u, v), d, cells->weight[3]);
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
  const DI di;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  V visibility = hn::LoadU(d, row.visibility + at);
  visibility = hn::IfThenElse(hn::Eq(visibility, visibility), Clamp01(visibility), one);
  const Vector n = Unit(LoadVector(row.normal, at), {zero, zero, one});
  Vector axis = n;
  if constexpr (kTechnique != LightingTechnique::kAmbientOcclusion) {
    axis = Unit(LoadVector(row.bent, at), n);
  }

  Cells cells;
  V angle = hn::Set(d, kHalfPi), cosine = zero;
  HWY_ALIGN float between[kMaxLanes];
  VI level = hn::Set(di, kLevels - 1);
  if constexpr (kCone) {
    angle = hn::LoadU(d, row.angle + at);
    angle = hn::IfThenElse(hn::Eq(angle, angle), angle, hn::Set(d, kHalfPi));
    angle = hn::Min(hn::Max(angle, zero), hn::Set(d, kHalfPi));
    cosine = hn::Max(hn::Cos(d, angle), zero);
    const V above = hn::Max(hn::MulSub(angle, hn::Set(d, 1 / kLevelStep), one), zero);
    level = hn::Min(hn::ConvertTo(di, above), hn::Set(di, kLevels - 2));
    hn::Store(hn::Min(hn::Sub(above, hn::ConvertTo(d, level)), one), d, between);
  }
  FindCells(f, ToWorld(f, axis), level, &cells);
  Vector rgb = LookUp<kCone>(f, cells, between);

  V scale = visibility;
  const V bend = Clamp01(Dot(axis, n));
  if (f.geometric_term) scale = hn::Mul(scale, bend);
  // t of the paper over that of the table: sin^2(a) / (1 - cos a).
  if (kCone && f.paper_normalisation) scale = hn::Mul(scale, hn::Add(one, cosine));
  rgb = {hn::Mul(rgb.x, scale), hn::Mul(rgb.y, scale), hn::Mul(rgb.z, scale)};

  if (f.sun_shines) {
    const Vector s{hn::Set(d, f.sun[0]), hn::Set(d, f.sun[1]), hn::Set(d, f.sun[2])};
    V shade = visibility;
    V facing = hn::Max(Dot(axis, s), zero);
    if constexpr (kCone) {
      // The share of the disc inside the cone, linear in the angle between sun and axis.
      const V off = hn::Acos(d, hn::Min(hn::Max(Dot(axis, s), hn::Set(d, -1.0f)), one));
      const V radius = hn::Set(d, f.sun_radius);
      const V inside =
          Clamp01(hn::Div(hn::Sub(hn::Add(angle, radius), off), hn::Add(radius, radius)));
      // The share of the cone that is open: visibility over that of the whole cone.
      const V whole = f.uniform_weights ? hn::Sub(one, cosine)
                                        : hn::Mul(hn::NegMulAdd(cosine, cosine, one), bend);
      const V open = Clamp01(hn::Div(visibility, hn::Max(whole, hn::Set(d, 1e-4f))));
      shade = hn::Mul(inside, open);
      facing = hn::Max(Dot(n, s), zero);
    }
    const V w = hn::Mul(facing, shade);
    rgb = {hn::MulAdd(w, hn::Set(d, f.sun_rgb[0]), rgb.x),
           hn::MulAdd(w, hn::Set(d, f.sun_rgb[1]), rgb.y),
           hn::MulAdd(w, hn::Set(d, f.sun_rgb[2]), rgb.z)};
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
    const V length = hn::Sqrt(Dot(v, v));
    const Vector unit = Unit(v, {zero, zero, one});
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
