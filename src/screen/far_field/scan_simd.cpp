#include <cstddef>
#include <limits>

#include "screen/far_field/scan_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/scan_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

void ScanStrip(const StripJob& job) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), slope = hn::Set(d, job.slope);
  const V inf = hn::Set(d, std::numeric_limits<float>::infinity());
  for (int j = job.begin; j < job.end; j += static_cast<int>(hn::Lanes(d))) {
    V nearest = inf, slanted = hn::Neg(inf);
    for (int i = 0; i < job.row_count; ++i) {
      const ScanRow& row = job.rows[i];
      const V a = hn::LoadU(d, row.lattice + j), b = hn::LoadU(d, row.next + j);
      const V blend = hn::Set(d, row.blend);
      // Beside the background the nearer texel decides: a skirt that falls to infinity within one
      // cell would spoil the averages.
      const V single = row.blend < 0.5f ? a : b;
      const auto both = hn::Gt(hn::Min(a, b), zero);
      const V g = hn::IfThenElse(both, hn::MulAdd(blend, hn::Sub(b, a), a), single);
      const auto surface = hn::Gt(g, zero);
      const V depth = job.orthographic ? hn::Sub(hn::Set(d, job.ortho_offset), g) : hn::Div(one, g);
      const V outward = hn::Mul(hn::Set(d, row.outward), job.orthographic ? one : depth);
      const V height = hn::MulSub(slope, outward, depth);
      nearest = hn::Min(nearest, hn::IfThenElse(surface, depth, inf));
      slanted = hn::Max(slanted, hn::IfThenElse(surface, height, hn::Neg(inf)));
    }
    hn::StoreU(nearest, d, job.out.nearest + j);
    hn::StoreU(slanted, d, job.out.slanted + j);
  }
}

// One connected piece of matter of a line.
struct Piece {
  V nearest, slanted, deepest;
};
HWY_INLINE void KeepNearer(const Piece& piece, Piece* best) {
  const auto nearer = hn::Lt(piece.nearest, best->nearest);
  best->nearest = hn::IfThenElse(nearer, piece.nearest, best->nearest);
  best->slanted = hn::IfThenElse(nearer, piece.slanted, best->slanted);
  best->deepest = hn::IfThenElse(nearer, piece.deepest, best->deepest);
}

void ScanMatter(const StripJob& job) {
  const D d;
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0f), slope = hn::Set(d, job.slope);
  const V inf = hn::Set(d, std::numeric_limits<float>::infinity());
  const V slack = hn::Set(d, job.slack);
  for (int j = job.begin; j < job.end; j += static_cast<int>(hn::Lanes(d))) {
    Piece best{inf, hn::Neg(inf), zero}, piece = best;
    V last = inf, last_back = zero;
    for (int i = 0; i < job.row_count; ++i) {
      const ScanRow& row = job.rows[i];
      auto depth_of = [&](V g) HWY_ATTR {
        return job.orthographic ? hn::Sub(hn::Set(d, job.ortho_offset), g) : hn::Div(one, g);
      };
      const V a = hn::LoadU(d, row.lattice + j), b = hn::LoadU(d, row.next + j);
      const V back_a = hn::LoadU(d, row.back + j), back_b = hn::LoadU(d, row.next_back + j);
      const V tiny = hn::Set(d, 1e-30f);
      const V da = depth_of(hn::Max(a, tiny)), db = depth_of(hn::Max(b, tiny));
      // Between texels whose matter does not touch, the nearer one decides.
      const auto both = hn::And(hn::Gt(hn::Min(a, b), zero),
                                hn::Le(hn::Sub(hn::Max(da, db), hn::Min(back_a, back_b)),
                                       hn::Mul(slack, hn::Min(da, db))));
      const bool first = row.blend < 0.5f;
      const V blended = hn::MulAdd(hn::Set(d, row.blend), hn::Sub(b, a), a);
      const V g = hn::IfThenElse(both, blended, first ? a : b);
      const auto surface = hn::Gt(g, zero);
      const V depth = depth_of(hn::Max(g, tiny));
      const V back = hn::Max(first ? back_a : back_b, depth);
      const V outward = hn::Mul(hn::Set(d, row.outward), job.orthographic ? one : depth);
      const V height = hn::MulSub(slope, outward, depth);
      const auto joined =
          hn::And(surface, hn::Le(hn::Sub(hn::Max(depth, last), hn::Min(back, last_back)),
                                  hn::Mul(slack, hn::Min(depth, last))));
      // A piece that goes on is not compared yet: what is still to come belongs to it.
      Piece ended = piece;
      ended.nearest = hn::IfThenElse(joined, inf, piece.nearest);
      KeepNearer(ended, &best);
      piece.nearest = hn::IfThenElse(
          surface, hn::IfThenElse(joined, hn::Min(piece.nearest, depth), depth), inf);
      piece.slanted = hn::IfThenElse(joined, hn::Max(piece.slanted, height), height);
      piece.deepest = hn::IfThenElse(joined, hn::Max(piece.deepest, back), back);
      last = hn::IfThenElse(surface, depth, inf);
      last_back = hn::IfThenElse(surface, back, zero);
    }
    KeepNearer(piece, &best);
    hn::StoreU(best.nearest, d, job.out.nearest + j);
    hn::StoreU(best.slanted, d, job.out.slanted + j);
    hn::StoreU(best.deepest, d, job.out.deepest + j);
  }
}

void MergeMatter(int lines, float slack, const RawStrip& a, const RawStrip& b,
                 const RawStrip& out) {
  const D d;
  for (int j = 0; j < lines; j += static_cast<int>(hn::Lanes(d))) {
    auto load = [&](const RawStrip& s) HWY_ATTR {
      return Piece{hn::LoadU(d, s.nearest + j), hn::LoadU(d, s.slanted + j),
                   hn::LoadU(d, s.deepest + j)};
    };
    const Piece p = load(a), q = load(b);
    Piece nearer = p;
    KeepNearer(q, &nearer);
    const V inf = hn::Set(d, std::numeric_limits<float>::infinity());
    const V farther = hn::Max(p.nearest, q.nearest);
    const auto joined =
        hn::And(hn::Lt(farther, inf), hn::Le(hn::Sub(farther, hn::Min(p.deepest, q.deepest)),
                                             hn::Mul(hn::Set(d, slack), nearer.nearest)));
    hn::StoreU(nearer.nearest, d, out.nearest + j);
    hn::StoreU(hn::IfThenElse(joined, hn::Max(p.slanted, q.slanted), nearer.slanted), d,
               out.slanted + j);
    hn::StoreU(hn::IfThenElse(joined, hn::Max(p.deepest, q.deepest), nearer.deepest), d,
               out.deepest + j);
  }
}

void MergeStrips(int lines, const RawStrip& a, const RawStrip& b, const RawStrip& out) {
  const D d;
  for (int j = 0; j < lines; j += static_cast<int>(hn::Lanes(d))) {
    hn::StoreU(hn::Min(hn::LoadU(d, a.nearest + j), hn::LoadU(d, b.nearest + j)), d,
               out.nearest + j);
    hn::StoreU(hn::Max(hn::LoadU(d, a.slanted + j), hn::LoadU(d, b.slanted + j)), d,
               out.slanted + j);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(ScanStrip);
HWY_EXPORT(MergeStrips);
HWY_EXPORT(ScanMatter);
HWY_EXPORT(MergeMatter);

void scan_strip(const StripJob& job) { HWY_DYNAMIC_DISPATCH(ScanStrip)(job); }

void scan_matter(const StripJob& job) { HWY_DYNAMIC_DISPATCH(ScanMatter)(job); }

void merge_matter(int lines, float slack, const RawStrip& a, const RawStrip& b,
                  const RawStrip& out) {
  HWY_DYNAMIC_DISPATCH(MergeMatter)(lines, slack, a, b, out);
}

void merge_strips(int lines, const RawStrip& a, const RawStrip& b, const RawStrip& out) {
  HWY_DYNAMIC_DISPATCH(MergeStrips)(lines, a, b, out);
}

// A running sum is a chain of additions, which lanes would not shorten.
void sum_lines(int lines, int phases, std::ptrdiff_t phase_stride, float slope,
               const RawStrip& strip, const PrefixSums& sums) {
  constexpr int kPad = PrefixSums::kPadding;
  const int phase_lines = (lines + phases - 1) / phases;
  double depth = 0, outward = 0;
  float count = 0;
  auto set = [&](std::ptrdiff_t at) {
    sums.depth[at] = depth;
    sums.outward[at] = outward;
    sums.count[at] = count;
  };
  auto pad = [&](int from, int to) {
    for (int phase = 0; phase < phases; ++phase) {
      for (int i = from; i < to; ++i) set(phase * phase_stride + i);
    }
  };
  pad(-kPad, 0);
  for (int i = 0; i < phase_lines; ++i) {
    for (int phase = 0; phase < phases; ++phase) {
      const std::ptrdiff_t at = phase * phase_stride + i;
      set(at);
      if (i * phases + phase >= lines) continue;
      const bool surface = strip.nearest[at] < std::numeric_limits<float>::infinity();
      depth += surface ? strip.nearest[at] : 0.0f;
      // The two receiver lines meet where z = m0 and slope x = m1 - m0.
      outward += surface ? slope * (strip.slanted[at] + strip.nearest[at]) : 0.0f;
      count += surface ? 1.0f : 0.0f;
    }
  }
  pad(phase_lines, phase_lines + 2 * kPad);
}

}  // namespace obscura::far_field
#endif
