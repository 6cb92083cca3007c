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

void ScanStrip(const StripJob& job) {
  const D d;
  const V zero = hn::Zero(d), slope = hn::Set(d, job.slope),
          ortho_offset = hn::Set(d, job.ortho_offset);
  for (int j = job.begin; j < job.end; j += static_cast<int>(hn::Lanes(d))) {
    Piece found = leaf::no_piece();
    for (int i = 0; i < job.row_count; ++i) {
      const ScanRow& row = job.rows[i];
      const V a = hn::LoadU(d, row.lattice + j), b = hn::LoadU(d, row.next + j);
      const V g = leaf::between_texels(a, b, row.blend < 0.5f ? a : b, hn::Set(d, row.blend));
      const V depth = leaf::depth_of_lattice(g, ortho_offset, job.orthographic);
      const V height =
          leaf::slanted_height(slope, hn::Set(d, row.outward), depth, job.orthographic);
      found = leaf::add_row(found, hn::Gt(g, zero), depth, height);
    }
    StorePiece(found, job.out, j);
  }
}

void ScanMatter(const StripJob& job) {
  const D d;
  const V zero = hn::Zero(d), slope = hn::Set(d, job.slope),
          ortho_offset = hn::Set(d, job.ortho_offset);
  const V slack = hn::Set(d, job.slack), tiny = hn::Set(d, leaf::kSmallest);
  for (int j = job.begin; j < job.end; j += static_cast<int>(hn::Lanes(d))) {
    leaf::MatterScan m = leaf::start_matter_scan();
    for (int i = 0; i < job.row_count; ++i) {
      const ScanRow& row = job.rows[i];
      auto depth_of = [&](V g) HWY_ATTR {
        return leaf::depth_of_lattice(hn::Max(g, tiny), ortho_offset, job.orthographic);
      };
      const V a = hn::LoadU(d, row.lattice + j), b = hn::LoadU(d, row.next + j);
      const V back_a = hn::LoadU(d, row.back + j), back_b = hn::LoadU(d, row.next_back + j);
      const bool first = row.blend < 0.5f;
      const V g = leaf::between_matter(a, b, first ? a : b, hn::Set(d, row.blend), depth_of(a),
                                       depth_of(b), back_a, back_b, slack);
      const V depth = depth_of(g);
      const V height =
          leaf::slanted_height(slope, hn::Set(d, row.outward), depth, job.orthographic);
      leaf::add_matter_row(hn::Gt(g, zero), depth, hn::Max(first ? back_a : back_b, depth), height,
                           slack, m);
    }
    const Piece best = leaf::nearer_piece(m.piece, m.best);
    StorePiece(best, job.out, j);
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
    const Piece merged = leaf::merged_matter(load(a), load(b), hn::Set(d, slack));
    StorePiece(merged, out, j);
    hn::StoreU(merged.deepest, d, out.deepest + j);
  }
}

void MergeStrips(int lines, const RawStrip& a, const RawStrip& b, const RawStrip& out) {
  const D d;
  for (int j = 0; j < lines; j += static_cast<int>(hn::Lanes(d))) {
    const Piece p{hn::LoadU(d, a.nearest + j), hn::LoadU(d, a.slanted + j), hn::Zero(d)};
    const Piece q{hn::LoadU(d, b.nearest + j), hn::LoadU(d, b.slanted + j), hn::Zero(d)};
    StorePiece(leaf::merged_strips(p, q), out, j);
  }
}

}  // namespace far_field::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "math/leaf_scalar.h"

namespace obscura::leaf_scalar {
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
      outward +=
          surface ? leaf_scalar::outward_of(slope, strip.nearest[at], strip.slanted[at]) : 0.0f;
      count += surface ? 1.0f : 0.0f;
    }
  }
  pad(phase_lines, phase_lines + 2 * kPad);
}

}  // namespace obscura::far_field
#endif
