#include <algorithm>
#include <cstddef>
#include <limits>

#include "screen/far_field/scan_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/scan_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "math/apart_leaf.h"
#include "view/taps_leaf.h"
// After taps_leaf.h.
#include "screen/far_field/lattice_leaf.h"
// After lattice_leaf.h.
#include "screen/far_field/scan_leaf.h"
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace far_field::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace leaf = obscura::HWY_NAMESPACE::leaf;
using leaf::Piece;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

HWY_INLINE void StorePiece(const Piece& p, const RawStrip& out, int j) {
  const D d;
  hn::StoreU(p.nearest, d, out.nearest + j);
  hn::StoreU(p.slanted, d, out.slanted + j);
}

HWY_INLINE void StoreMatter(const leaf::Matter& m, const RawStrip& out, int j) {
  const D d;
  StorePiece(m.first, out, j);
  hn::StoreU(m.first.deepest, d, out.deepest + j);
  hn::StoreU(m.first.begin, d, out.begin + j);
  hn::StoreU(m.first.end, d, out.end + j);
  hn::StoreU(m.rest.front, d, out.rest_front + j);
  hn::StoreU(m.rest.back, d, out.rest_back + j);
  hn::StoreU(m.rest.filled, d, out.rest_filled + j);
}
HWY_INLINE leaf::Matter LoadMatter(const RawStrip& s, int j) {
  const D d;
  auto load = [&](const float* values) HWY_ATTR { return hn::LoadU(d, values + j); };
  return {{load(s.nearest), load(s.slanted), load(s.deepest), load(s.begin), load(s.end)},
          {load(s.rest_front), load(s.rest_back), load(s.rest_filled)}};
}

void ScanStrip(const StripJob& job) {
  const D d;
  const V zero = hn::Zero(d), slope = hn::Set(d, job.slope);
  for (int j = job.begin; j < job.end; j += static_cast<int>(hn::Lanes(d))) {
    Piece found = leaf::no_piece();
    for (int i = 0; i < job.row_count; ++i) {
      const ScanRow& row = job.rows[i];
      const V a = hn::LoadU(d, row.lattice + j), b = hn::LoadU(d, row.next + j);
      const V g = leaf::between_texels(a, b, row.blend < 0.5f ? a : b, hn::Set(d, row.blend));
      const V depth = leaf::depth_of_lattice(g, job.orthographic);
      const V height =
          leaf::slanted_height(slope, hn::Set(d, row.outward), depth, job.orthographic);
      found = leaf::add_row(found, hn::Gt(g, zero), depth, height);
    }
    StorePiece(found, job.out, j);
  }
}

void ScanMatter(const StripJob& job) {
  const D d;
  const V slope = hn::Set(d, job.slope);
  const V slack = hn::Set(d, job.slack);
  for (int j = job.begin; j < job.end; j += static_cast<int>(hn::Lanes(d))) {
    leaf::MatterScan m = leaf::start_matter_scan();
    for (int i = 0; i < job.row_count; ++i) {
      const ScanRow& row = job.rows[i];
      const leaf::Crossing c = leaf::cross_matter(
          hn::LoadU(d, row.lattice + j), hn::LoadU(d, row.next + j), hn::LoadU(d, row.back + j),
          hn::LoadU(d, row.next_back + j), hn::Set(d, row.blend),
          leaf::leaf_truth(row.blend < 0.5f), slack, job.orthographic);
      const V outward = hn::Set(d, row.outward);
      const V height = leaf::slanted_height(slope, outward, c.depth, job.orthographic);
      leaf::add_matter_row(c.surface, c.depth, c.back, height, outward, slack, m);
    }
    StoreMatter(leaf::end_matter_scan(m), job.out, j);
  }
}

// A line as a strip holds it: beyond the window's padding nothing is seen, as in it.
HWY_INLINE int LineIn(const RawStrip& s, int j) {
  return std::clamp(j, s.window.begin - PrefixSums::kPadding, s.window.end);
}

template <class Merge>
HWY_INLINE void ForEachLine(const RawStrip& out, const Merge& merge) {
  const D d;
  const int end = out.window.end + PrefixSums::kPadding;
  for (int j = out.window.begin - PrefixSums::kPadding; j < end;
       j += static_cast<int>(hn::Lanes(d))) {
    merge(j);
  }
}

void MergeMatter(float slack, float row, const RawStrip& a, const RawStrip* b,
                 const RawStrip& out) {
  const D d;
  ForEachLine(out, [&](int j) HWY_ATTR {
    const leaf::Matter merged = leaf::merged_matter(
        LoadMatter(a, LineIn(a, j)), b ? LoadMatter(*b, LineIn(*b, j)) : leaf::no_matter(),
        hn::Set(d, slack), hn::Set(d, row));
    StoreMatter(merged, out, j);
  });
}

void MergeStrips(const RawStrip& a, const RawStrip& b, const RawStrip& out) {
  const D d;
  auto load = [&](const RawStrip& s, int j) HWY_ATTR {
    const int at = LineIn(s, j);
    return Piece{hn::LoadU(d, s.nearest + at), hn::LoadU(d, s.slanted + at), hn::Zero(d),
                 hn::Zero(d), hn::Zero(d)};
  };
  ForEachLine(out, [&](int j) HWY_ATTR {
    StorePiece(leaf::merged_strips(load(a, j), load(b, j)), out, j);
  });
}

}  // namespace far_field::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "math/leaf_scalar.h"

namespace obscura::leaf_scalar {
#include "math/apart_leaf.h"
#include "view/taps_leaf.h"
// After taps_leaf.h.
#include "screen/far_field/lattice_leaf.h"
}  // namespace obscura::leaf_scalar

namespace obscura::far_field {

HWY_EXPORT(ScanStrip);
HWY_EXPORT(MergeStrips);
HWY_EXPORT(ScanMatter);
HWY_EXPORT(MergeMatter);

void scan_strip(const StripJob& job) { HWY_DYNAMIC_DISPATCH(ScanStrip)(job); }

void scan_matter(const StripJob& job) { HWY_DYNAMIC_DISPATCH(ScanMatter)(job); }

void merge_matter(float slack, float row, const RawStrip& a, const RawStrip* b,
                  const RawStrip& out) {
  HWY_DYNAMIC_DISPATCH(MergeMatter)(slack, row, a, b, out);
}

void merge_strips(const RawStrip& a, const RawStrip& b, const RawStrip& out) {
  HWY_DYNAMIC_DISPATCH(MergeStrips)(a, b, out);
}

// A running sum is a chain of additions, which lanes would not shorten.
void sum_lines(int lines, int phases, std::ptrdiff_t phase_stride, float slope,
               const RawStrip& strip, const PrefixSums& sums) {
  constexpr int kPad = PrefixSums::kPadding;
  const LineWindow& window = strip.window;
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
  pad(window.begin - kPad, window.begin);
  for (int i = window.begin; i < window.end; ++i) {
    for (int phase = 0; phase < phases; ++phase) {
      const std::ptrdiff_t at = phase * phase_stride + i;
      set(at);
      if (i * phases + phase >= lines) continue;
      const bool surface = strip.nearest[at] < std::numeric_limits<float>::infinity();
      depth += surface ? strip.nearest[at] : 0.0f;
      // The two receiver lines meet where z = m0 and slope x = m1 - m0.
      outward +=
          surface ? leaf_scalar::outward_of(slope, strip.nearest[at], strip.slanted[at]) : 0.0f;
      count += surface ? 1.0f : 0.0f;
    }
  }
  pad(window.end, window.end + 2 * kPad);
}

}  // namespace obscura::far_field
#endif
