#include "screen/horizon/kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/horizon/kernel_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "core/gather-inl.h"
#include "hwy/highway.h"
#include "math/slice-inl.h"
#include "view/taps-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "screen/horizon/lines_leaf.h"
// After lines_leaf.h.
#include "screen/horizon/box_leaf.h"
// The shader's specialization constants are the class's parameters.
template <FalloffKind kKind, bool kChord, SliceSums kSliceSums>
struct LineSlices : SliceIntegral<kKind, kChord, kSliceSums> {
  using Base = SliceIntegral<kKind, kChord, kSliceSums>;
  using Base::along_tangent;
  using Base::along_zenith;
  using Base::kSums;
  HWY_INLINE explicit LineSlices(const math::Rho& rho) : Base(rho) {}
#include "screen/horizon/slices_leaf.h"
};
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace horizon::HWY_NAMESPACE {

namespace leaf = obscura::HWY_NAMESPACE::leaf;
using namespace obscura::HWY_NAMESPACE::taps;
namespace om = obscura::HWY_NAMESPACE;
using M = hn::Mask<D>;
using leaf::ImageLine;
using leaf::LinePoint;
using leaf::LineReceiver;
using leaf::ObscuredSums;

// The pixels of a vector: those of one row that stand at the same place in the pattern's tile, so
// that all lanes look in the same directions. They share texels and branches as neighbours would
// that look elsewhere do not. Lanes beyond the row's end see its last pixel.
struct Pixels {
  HWY_INLINE Pixels(const Frame& f, int visible_row, int first, int width)
      : row(visible_row),
        phase(first % f.interleave),
        count(std::min(static_cast<int>(hn::Lanes(D())),
                       (width - first + f.interleave - 1) / f.interleave)),
        at((f.view.top + row) * f.view.stride + f.view.left) {
    for (int lane = 0; lane < static_cast<int>(hn::Lanes(D())); ++lane) {
      column[lane] = std::min(first + lane * f.interleave, width - 1);
    }
  }
  // Of an image like view.depth.
  HWY_INLINE V Load(const float* image) const { return om::GatherLanes(D(), image + at, column); }
  HWY_INLINE Vec3 Normal(const view::TapFrame& f) const {
    return {Load(f.normal_x), Load(f.normal_y), Load(f.normal_z)};
  }
  HWY_INLINE void Store(V values, float* out) const {
    HWY_ALIGN float lanes[kMaxLanes];
    hn::Store(values, D(), lanes);
    for (int lane = 0; lane < count; ++lane) out[column[lane]] = lanes[lane];
  }

  HWY_ALIGN std::int32_t column[kMaxLanes];
  const int row, phase, count;
  const std::ptrdiff_t at;
};

// Calls each(pixels) for all pixels of a visible row.
template <class Each>
HWY_INLINE void ForPixels(const Frame& f, int row, int width, Each each) {
  const int block = f.interleave * static_cast<int>(hn::Lanes(D()));
  for (int x = 0; x < width; x += block) {
    for (int i = x; i < std::min(x + f.interleave, width); ++i) each(Pixels(f, row, i, width));
  }
}

HWY_INLINE LineReceiver MakeReceiver(const Frame& f, const Pixels& pixels, const Vec3& n, V z) {
  const D d;
  const DI di;
  const Camera& c = f.view.camera;
  const V one = hn::Set(d, 1.0f);
  const V perspective = hn::Set(d, c.orthographic ? 0.0f : 1.0f);
  const V u = hn::ConvertTo(d, hn::Add(hn::Load(di, pixels.column), hn::Set(di, f.view.left)));
  const V v = hn::Set(d, static_cast<float>(f.view.top + pixels.row));
  const V a = hn::Mul(perspective,
                      hn::Mul(hn::Sub(u, hn::Set(d, c.center_u - 0.5f)), hn::Set(d, c.scale_x)));
  const V b = hn::Mul(perspective,
                      hn::Mul(hn::Sub(v, hn::Set(d, c.center_v - 0.5f)), hn::Set(d, c.scale_y)));
  return leaf::make_line_receiver(u, v, hn::IfThenElse(hn::Lt(z, hn::Inf(d)), z, one), n.x, n.y,
                                  n.z, a, b, c.orthographic);
}

HWY_INLINE ImageLine MakeLine(const Frame& f, const LineReceiver& r, V cosine, V sine) {
  const D d;
  const Camera& c = f.view.camera;
  return leaf::make_image_line(r, cosine, sine, hn::Set(d, 1 / c.scale_x),
                               hn::Set(d, 1 / c.scale_y), hn::Set(d, f.reach),
                               hn::Set(d, static_cast<float>(f.view.width - 1)),
                               hn::Set(d, static_cast<float>(f.view.height - 1)));
}

// The rotation of direction k, and its samples' shift.
struct Turn {
  V cosine, sine, shift;
};
HWY_INLINE Turn MakeTurn(const Frame& f, const Pixels& pixels, int k) {
  const D d;
  auto tile = [&](int value) HWY_ATTR {
    return hn::Set(d, f.tile[value][pixels.row % f.interleave][pixels.phase]);
  };
  const V c = hn::Set(d, f.cosine[k]), s = hn::Set(d, f.sine[k]);
  const V tc = tile(kTileCos), ts = tile(kTileSin);
  const V shift = hn::Add(tile(kTileShift), hn::Set(d, f.shift[k]));
  return {hn::MulSub(c, tc, hn::Mul(s, ts)), hn::MulAdd(s, tc, hn::Mul(c, ts)),
          hn::Sub(shift, hn::Floor(shift))};
}

// A sample's texel: its depth, how many pixels away, and of kMatter where its matter ends, if an
// image says so, and how many pixels farther along the line it is than the sample before.
struct Texel {
  V depth, ku, kv;
  V back, between;
};

// The surface points at the samples along a line, one after the other, for add(point, texel). Their
// texels are found, then read a batch at a time, so that no load waits for the index that was
// stored just before it, nor for what the point before makes of its own.
constexpr int kBatch = 8;
template <bool kSquared, bool kMatter, class Add>
HWY_INLINE void ForPoints(const Frame& f, const LineReceiver& r, const ImageLine& line, V shift,
                          Add add) {
  const D d;
  const DI di;
  const Camera& c = f.view.camera;
  const V zero = hn::Zero(d), round = hn::Set(d, kRound);
  const V per_step = hn::Set(d, 1.0f / static_cast<float>(f.steps));
  const V last_u = hn::Set(d, f.view.width - 1.0f), last_v = hn::Set(d, f.view.height - 1.0f);
  const V scale_u = hn::Set(d, c.scale_x), scale_v = hn::Set(d, c.scale_y);
  const VI stride = hn::Set(di, static_cast<std::int32_t>(f.view.stride));
  const VI middle = hn::Set(di, f.view.height / 2);  // rows count from there, as taps' do
  HWY_ALIGN std::int32_t index[kBatch][kMaxLanes];
  HWY_ALIGN float depth[kBatch][kMaxLanes];
  HWY_ALIGN float offset[2][kBatch][kMaxLanes];
  HWY_ALIGN float back[kBatch][kMaxLanes], between[kBatch][kMaxLanes];
  const float* backs = kMatter && f.back ? f.back + (f.view.height / 2) * f.view.stride : nullptr;
  V before = zero;
  for (int first = 0; first < f.steps; first += kBatch) {
    const int count = std::min(kBatch, f.steps - first);
    for (int j = 0; j < count; ++j) {
      const V pixels = leaf::sample_at(line, shift, hn::Set(d, static_cast<float>(first + j)),
                                       per_step, kSquared);
      const V kx = hn::Sub(hn::MulAdd(pixels, line.du, round), round);
      const V ky = hn::Sub(hn::MulAdd(pixels, line.dv, round), round);
      const V x = hn::Min(hn::Max(hn::Add(r.u, kx), zero), last_u);
      const V y = hn::Min(hn::Max(hn::Add(r.v, ky), zero), last_v);
      const VI row = hn::Sub(hn::ConvertTo(di, y), middle);
      hn::Store(hn::Add(hn::Mul(row, stride), hn::ConvertTo(di, x)), di, index[j]);
      hn::Store(hn::Mul(hn::Sub(x, r.u), scale_u), d, offset[0][j]);
      hn::Store(hn::Mul(hn::Sub(y, r.v), scale_v), d, offset[1][j]);
      if constexpr (kMatter) {
        hn::Store(hn::Sub(pixels, before), d, between[j]);
        before = pixels;
      }
    }
    for (int j = 0; j < count; ++j) {
      hn::Store(om::GatherLanes(d, Base(f.view), index[j]), d, depth[j]);
      if (backs) hn::Store(om::GatherLanes(d, backs, index[j]), d, back[j]);
    }
    for (int j = 0; j < count; ++j) {
      const V q = hn::Load(d, depth[j]);
      const V ku = hn::Load(d, offset[0][j]), kv = hn::Load(d, offset[1][j]);
      Texel texel{q, ku, kv, zero, zero};
      if constexpr (kMatter) {
        texel.back = backs ? hn::Load(d, back[j]) : q;
        texel.between = hn::Load(d, between[j]);
      }
      add(leaf::line_point(r, line, ku, kv, q, c.orthographic), texel);
    }
  }
}

HWY_INLINE void StoreDirections(const LineReceiver& r, const Vec3& n, const ObscuredSums& sum,
                                V whole, V each, const Pixels& pixels, Rows out) {
  const leaf::EyeVector e = leaf::obscured_in_eye_space(r, n.x, n.y, n.z, sum, whole, each);
  pixels.Store(e.x, out[1]);
  pixels.Store(e.y, out[2]);
  pixels.Store(e.z, out[3]);
}

template <FalloffKind kKind, bool kChord, SliceSums kSums>
HWY_INLINE leaf::Obscured SliceOf(const Frame& f, const LineReceiver& r, const ImageLine& line,
                                  V shift, const leaf::Slice& slice) {
  const D d;
  leaf::LineSlices<kKind, kChord, kSums> slices(*f.rho);
  if constexpr (kKind == FalloffKind::kConstant) {
    const V radius = hn::Set(d, f.rho->radius), inverse_radius = hn::Set(d, f.rho->inverse_radius);
    V cosine = slice.edge_cosine;
    ForPoints<true, false>(f, r, line, shift, [&](const LinePoint& p, const Texel&) HWY_ATTR {
      const V c = leaf::cut_cosine(slice, p.x, p.y, radius, inverse_radius);
      cosine = hn::IfThenElse(p.valid, hn::Max(cosine, c), cosine);
    });
    return slices.finish_constant(slice, cosine);
  } else {
    leaf::Horizon h = slices.start_horizon(slice, true);
    const V one = hn::Set(d, 1.0f);
    ForPoints<true, false>(f, r, line, shift, [&](const LinePoint& p, const Texel&) HWY_ATTR {
      slices.add_point(slice, p.x, p.y, p.valid, false, one, h);
    });
    return slices.finish_falling(h);
  }
}

// Where the matter of texels ends that begins at `depth`: a thickness behind, or at `given`.
HWY_INLINE V BackOf(const Frame& f, V depth, V given, V a, V b) {
  const D d;
  if (f.matter == view::Matter::kThickness) {
    return leaf::back_of_thickness(depth, hn::Set(d, f.thickness), a, b,
                                   f.view.camera.orthographic);
  }
  return hn::Max(hn::Min(given, hn::Set(d, leaf::kFarBack)), depth);
}

// The same where matter has an end; `own` is where the receiver's does.
template <FalloffKind kKind, SliceSums kSums>
HWY_INLINE leaf::Obscured MatterSliceOf(const Frame& f, const LineReceiver& r,
                                        const ImageLine& line, V shift, const leaf::Slice& slice,
                                        V own) {
  const D d;
  const Camera& c = f.view.camera;
  const bool parallel = c.orthographic;
  const V one = hn::Set(d, 1.0f);
  const V footprint = hn::Set(d, std::max(c.scale_x, c.scale_y));
  const V dither = hn::Sub(shift, hn::Set(d, 0.5f));
  leaf::SliceIntegral<kKind, true, kSums> slices(*f.rho);
  leaf::Sectors m = leaf::start_sectors(slice, true, r.z, own);
  auto add = [&](const LinePoint& p, const Texel& t) HWY_ATTR __attribute__((always_inline)) {
    const M always = leaf::leaf_truth(true);
    const V depth = hn::IfThenElse(p.valid, t.depth, one);
    const V distance = parallel ? r.distance : depth;
    const V reach = leaf::reach_of_sample(line, t.between, distance);
    const V slack = leaf::slack_of_samples(hn::Mul(footprint, distance), t.between);
    const V back = BackOf(f, depth, t.back, hn::Add(r.a, t.ku), hn::Add(r.b, t.kv));
    const leaf::MatterBox box = leaf::line_box(slice, p, reach, depth, back, parallel);
    slices.add_matter(slice, box, always, slack, dither, p.valid, m);
  };
  ForPoints<true, true>(f, r, line, shift, add);
  return leaf::finish_sectors(m);
}

template <FalloffKind kKind, bool kChord, bool kMatter, SliceSums kSums>
void Slices(const Frame& f, int row, int width, Rows out) {
  const D d;
  leaf::LineSlices<kKind, kChord, kSums> rho(*f.rho);
  const bool orthographic = f.view.camera.orthographic;
  const V one = hn::Set(d, 1.0f), perspective = hn::Set(d, orthographic ? 0.0f : 1.0f);
  const V each = hn::Set(d, 1.0f / static_cast<float>(f.directions)), twice = hn::Add(each, each);
  ForPixels(f, row, width, [&](const Pixels& pixels) HWY_ATTR {
    const Vec3 n = pixels.Normal(f.view);
    LineReceiver r = MakeReceiver(f, pixels, n, pixels.Load(f.view.depth));
    r.limit = rho.depth_without_effect(r.z);
    const V camera = orthographic ? one : hn::Mul(r.z, r.ray_length);
    V own = one;
    if constexpr (kMatter) {
      own = BackOf(f, r.z, f.back ? pixels.Load(f.back) : r.z, r.a, r.b);
    }
    ObscuredSums sum = leaf::nothing_obscured();
    for (int k = 0; k < f.directions; ++k) {
      const Turn turn = MakeTurn(f, pixels, k);
      const ImageLine line = MakeLine(f, r, turn.cosine, turn.sine);
      const leaf::Slice slice = leaf::make_slice(r.nz, line.nt, camera, perspective);
      leaf::Obscured o;
      if constexpr (kMatter) {
        o = MatterSliceOf<kKind, kSums>(f, r, line, turn.shift, slice, own);
      } else {
        o = SliceOf<kKind, kChord, kSums>(f, r, line, turn.shift, slice);
      }
      leaf::add_obscured(o, turn.cosine, turn.sine, kSums != SliceSums::kVisibility, sum);
    }
    // w_k = 2 pi / K.
    const V visibility = hn::NegMulAdd(sum.visibility, twice, one);
    pixels.Store(visibility, out[0]);
    if constexpr (kSums == SliceSums::kUniform) {
      const V whole = hn::Mul(hn::Mul(sum.solid, each), hn::Set(d, 0.5f));
      StoreDirections(r, n, sum, whole, each, pixels, out);
    } else if constexpr (kSums == SliceSums::kCosine) {
      const V whole = hn::Mul(hn::Sub(one, visibility), hn::Set(d, 2.0f / 3));
      StoreDirections(r, n, sum, whole, twice, pixels, out);
    }
  });
}

template <SliceSums kSums>
void SlicesOf(const Frame& f, int row, int width, Rows out) {
  math::with_falloff_kind(f.rho->kind, [&]<FalloffKind kKind>() {
    if (f.matter != view::Matter::kSolid) {
      Slices<kKind, false, true, kSums>(f, row, width, out);
    } else if (kKind == FalloffKind::kConstant || !f.chord) {
      Slices<kKind, false, false, kSums>(f, row, width, out);
    } else {
      Slices<kKind, kKind != FalloffKind::kConstant, false, kSums>(f, row, width, out);
    }
  });
}

void SlicesAny(const Frame& f, SliceSums sums, int row, int width, Rows out) {
  switch (sums) {
    case SliceSums::kVisibility:
      return SlicesOf<SliceSums::kVisibility>(f, row, width, out);
    case SliceSums::kUniform:
      return SlicesOf<SliceSums::kUniform>(f, row, width, out);
    case SliceSums::kCosine:
      return SlicesOf<SliceSums::kCosine>(f, row, width, out);
  }
}

template <bool kDirections>
void Classic(const Frame& f, int row, int width, Rows out) {
  const D d;
  const V one = hn::Set(d, 1.0f), half = hn::Set(d, 0.5f);
  const V inverse = hn::Set(d, 1 / (f.reach * f.reach));
  const V each = hn::Set(d, 1.0f / static_cast<float>(f.directions));
  ForPixels(f, row, width, [&](const Pixels& pixels) HWY_ATTR {
    const Vec3 n = pixels.Normal(f.view);
    const LineReceiver r = MakeReceiver(f, pixels, n, pixels.Load(f.view.depth));
    ObscuredSums sum = leaf::nothing_obscured();
    for (int k = 0; k < f.directions; ++k) {
      const Turn turn = MakeTurn(f, pixels, k);
      const ImageLine line = MakeLine(f, r, turn.cosine, turn.sine);
      leaf::ClassicHorizon h =
          leaf::start_classic(r, line, hn::Set(d, f.bias_sine), hn::Set(d, f.bias_cosine));
      auto add = [&](const LinePoint& p, const Texel&)
                     HWY_ATTR { leaf::add_classic(p, inverse, h); };
      ForPoints<false, false>(f, r, line, turn.shift, add);
      leaf::add_obscured(leaf::finish_classic(h), turn.cosine, turn.sine, kDirections, sum);
    }
    pixels.Store(hn::NegMulAdd(sum.solid, each, one), out[0]);
    if constexpr (kDirections) {
      StoreDirections(r, n, sum, hn::Mul(hn::Mul(sum.solid, each), half), each, pixels, out);
    }
  });
}

void ClassicAny(const Frame& f, int row, int width, Rows out) {
  out[1] ? Classic<true>(f, row, width, out) : Classic<false>(f, row, width, out);
}

}  // namespace horizon::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::horizon {

HWY_EXPORT(SlicesAny);
HWY_EXPORT(ClassicAny);

void slices_row(const Frame& frame, SliceSums sums, int row, int width, Rows out) {
  HWY_DYNAMIC_DISPATCH(SlicesAny)(frame, sums, row, width, out);
}
void classic_row(const Frame& frame, int row, int width, Rows out) {
  HWY_DYNAMIC_DISPATCH(ClassicAny)(frame, row, width, out);
}

}  // namespace obscura::horizon
#endif
