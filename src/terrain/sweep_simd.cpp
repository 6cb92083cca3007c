#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/sweep_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrain/sweep_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "terrain/chains-inl.h"
#include "terrain/quantities-inl.h"

#ifndef OBSCURA_TERRAIN_SWEEP_ONCE
#define OBSCURA_TERRAIN_SWEEP_ONCE
namespace obscura {
// The slope of a cell that has no horizon is below this.
inline constexpr float kNoSlope = -1e14f;

// Where line 0 of a block is in a swept row.
struct BlockPosition {
  const TerrainSweep& sweep;
  int first_line;

  double line(int row) const { return sweep.line(row); }
  int column(int row) const { return first_line + static_cast<int>(std::floor(line(row) + 0.5)); }
  bool in_grid(int row) const {
    const int x = column(row);
    return x + kLines > 0 && x < sweep.width;
  }
};

inline int first_terrain_line(const TerrainSweep& s) {
  return static_cast<int>(std::floor(-std::max(s.line(0), s.line(s.height - 1)))) - 1;
}
}  // namespace obscura
#endif

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

// One block of lines on its way through the grid.
class Block {
 public:
  Block(const TerrainSweep& sweep, int first_line, int worker, TerrainScratch* scratch)
      : s_(sweep),
        worker_(worker),
        hull_(scratch->hull),
        position_{sweep, first_line},
        back_(scratch->horizon_points.data()),
        forth_(scratch->block_points.data()),
        lines_(scratch->line_heights.data() + kLines),
        none_(scratch->line_heights.data()),
        slopes_(scratch->slopes.data()) {}

  void Run() {
    while (begin_ < s_.height && !position_.in_grid(begin_)) ++begin_;
    int end = s_.height;
    while (end > begin_ && !position_.in_grid(end - 1)) --end;
    std::fill_n(none_, kLines, kNoHeight);
    slot_of_row_0_ = s_.entries ? 1 + s_.rows_before : 1 - begin_;
    const bool leave = s_.entries && (s_.entries->wants_last_row() || s_.entries->wants_sides());
    for (int row = begin_; row < end; ++row) {
      SetRow(row);
      if (s_.entries) EnterLines();
      if (s_.window > 0) {
        FindLineHeights();
        LookBack();
      } else {
        std::fill(slopes_ + first_, slopes_ + last_, std::numeric_limits<float>::lowest());
      }
      if (leave) LeaveLines();
      if (inner_first_ >= inner_last_) continue;
      LookNear();
      AddSums();
    }
  }

 private:
  float* LineHeights(int slot) const {
    return lines_ + static_cast<std::ptrdiff_t>(s_.windows ? slot : slot & 1) * kLines;
  }
  const float* Row(int swept) const {
    return s_.heights + (s_.reversed ? s_.height - 1 - swept : swept) * s_.pitch;
  }

  void SetRow(int row) {
    row_ = row;
    slot_ = row + slot_of_row_0_;
    x0_ = position_.column(row);
    cells_ = Row(row);
    // Whole steps that touch the grid.
    first_ = std::max(0, -x0_ / kStep * kStep);
    last_ = std::min(kLines, (s_.width - x0_ + kStep - 1) / kStep * kStep);
    offset_ = s_.row_offset ? s_.row_offset[row] : 0.0f;
    const int grid_row = s_.reversed ? s_.height - 1 - row : row;
    inner_first_ = inner_last_ = 0;
    if (grid_row < s_.inner_row_begin || grid_row >= s_.inner_row_end) return;
    inner_first_ = std::max(0, (s_.inner_column_begin - x0_) / kStep * kStep);
    inner_last_ = std::min(kLines, (s_.inner_column_end - x0_ + kStep - 1) / kStep * kStep);
  }

  // Hangs up the chains of lines that have just come into the grid: of those in its first row, then
  // of one at most in each row, at either side.
  void EnterLines() {
    if (row_ == begin_) {
      back_.Clear(slot_ - 1);
      std::fill_n(LineHeights(slot_ - 1), kLines, kNoHeight);
    }
    const int before = row_ == 0 ? x0_ : position_.column(row_ - 1);
    for (int x = 0; x < s_.width; x += std::max(1, row_ == 0 ? 1 : s_.width - 1)) {
      const int line = x - x0_;
      if (line < 0 || line >= kLines) continue;
      const int x_before = before + line;
      if (row_ > 0 && x_before >= 0 && x_before < s_.width) continue;
      int slot = slot_ - 1;
      for (const LinePoint& p : s_.entries->before(position_.first_line + line, row_, worker_)) {
        if (p.row == row_ - 1) {
          LineHeights(slot)[line] = p.height;
          continue;
        }
        back_.Set(slot, line, p.height, p.row + slot_of_row_0_);
        slot = p.row + slot_of_row_0_;
      }
      back_.Set(slot, line, kChainEnd, 0);
    }
  }

  // Hands on the hulls of lines that are in the grid for the last time.
  void LeaveLines() {
    const int begin = std::max(0, -x0_), end = std::min(kLines, s_.width - x0_);
    if (row_ == s_.height - 1) {
      for (int line = begin; line < end && s_.entries->wants_last_row(); ++line) Leave(line);
    } else if (s_.entries->wants_sides()) {
      const int step = position_.column(row_ + 1) - x0_;
      if (step == 0) return;
      const int line = (step > 0 ? s_.width - 1 : 0) - x0_;
      if (line >= begin && line < end) Leave(line);
    }
  }
  void Leave(int line) {
    hull_.clear();
    hull_.push_back({LineHeights(slot_)[line], row_});
    float height = 0;
    for (int slot = slot_; back_.Next(slot, line, &height, &slot);) {
      hull_.push_back({height, slot - slot_of_row_0_});
    }
    s_.entries->leave(row_, x0_ + line, hull_, worker_);
  }

  void FindLineHeights() {
    const D d;
    const double x = position_.line(row_);
    const double e = x - std::floor(x + 0.5);
    const V fraction = hn::Set(d, static_cast<float>(std::fabs(e)));
    const V offset = hn::Set(d, offset_), no_height = hn::Set(d, 0.5f * kNoHeight);
    float* HWY_RESTRICT to = LineHeights(slot_);
    std::fill(to, to + first_, kNoHeight);
    std::fill(to + last_, to + kLines, kNoHeight);
    for (int i = first_; i < last_; i += kLanes) {
      const float* at = cells_ + x0_ + i;
      const V cell = hn::LoadU(d, at), beside = hn::LoadU(d, at + (e >= 0 ? 1 : -1));
      // Next to a cell without data the line has the cell's own height.
      const V z = hn::IfThenElse(hn::Lt(beside, no_height), cell,
                                 hn::MulAdd(fraction, hn::Sub(beside, cell), cell));
      hn::StoreU(hn::Add(z, offset), d, to + i);
    }
  }

  // Slopes from the cells to the horizons of their lines.
  void LookBack() {
    const D d;
    const int since = row_ - begin_;
    // A window is cut where blocks of as many rows meet, counted from the model's first: chains
    // lead through this block's rows from the viewer back, and through those of the block before
    // from the window's far end forth.
    const int in_block = s_.windows ? std::min(since, (s_.first_row + row_) % s_.window) : since;
    const int before_block = s_.windows ? std::min(s_.window, since - in_block) : 0;
    if (before_block > 0 && in_block == 0) TurnBlock(before_block);
    // Of the block before, what the window reaches.
    const int far = std::min(before_block, s_.window - in_block);
    const bool fresh = in_block == 0;
    const float* before = fresh && !s_.entries ? none_ : LineHeights(slot_ - 1);
    for (int i = 0; i < first_; i += kLanes) back_.ClearLines(slot_, i);
    for (int i = last_; i < kLines; i += kLanes) back_.ClearLines(slot_, i);
    for (int i = first_; i < last_; i += kStep) {
      V z[kTogether], height[kTogether], distance[kTogether];
      for (int u = 0; u < kTogether; ++u) {
        z[u] = hn::LoadU(d, LineHeights(slot_) + i + u * kLanes);
      }
      back_.Add(slot_, i, z, before, height, distance);
      if (i < inner_first_ || i >= inner_last_) continue;
      for (int u = 0; u < kTogether; ++u) {
        StoreSlope(i + u * kLanes, z[u], before, height[u], distance[u], false);
      }
      if (far <= 0) continue;
      const int reach = in_block + far;
      for (int u = 0; u < kTogether; ++u) {
        height[u] = hn::LoadU(d, LineHeights(slot_ - reach) + i + u * kLanes);
        distance[u] = hn::Set(d, static_cast<float>(reach));
      }
      forth_.Climb<false>(far, i, static_cast<float>(in_block), z, height, distance);
      for (int u = 0; u < kTogether; ++u) {
        StoreSlope(i + u * kLanes, z[u], before, height[u], distance[u], true);
      }
    }
  }

  // Makes the chains that lead forth through so many rows before this one, and ends those that lead
  // back.
  void TurnBlock(int rows) {
    const D d;
    for (int slot = 1; slot <= rows; ++slot) {
      const float* HWY_RESTRICT at = LineHeights(slot_ - slot);
      const float* HWY_RESTRICT after = slot == 1 ? none_ : LineHeights(slot_ - slot + 1);
      for (int i = 0; i < kLines; i += kStep) {
        V z[kTogether], height[kTogether], distance[kTogether];
        for (int u = 0; u < kTogether; ++u) z[u] = hn::LoadU(d, at + i + u * kLanes);
        forth_.Add(slot, i, z, after, height, distance);
      }
    }
    back_.Clear(slot_ - 1);
  }

  // The slope is that from the cell itself, not from its line at `line`, which passes beside it.
  // Left to the near samples is what they cover, and ground that rises as it does from the line's
  // point before: where it is a plane, its horizon is as near as it is far, rounding chooses, and a
  // slope between cell and line would be too steep.
  HWY_INLINE void StoreSlope(int i, V line, const float* HWY_RESTRICT before, V height, V distance,
                             bool with_others) {
    const D d;
    const V inverse = FastReciprocal(d, distance);
    const V z = hn::Add(hn::LoadU(d, cells_ + x0_ + i), hn::Set(d, offset_));
    V slope = hn::Mul(hn::Sub(height, z), hn::Mul(hn::Set(d, s_.inverse_step), inverse));
    if (s_.row_slope) slope = hn::Sub(slope, hn::Set(d, s_.row_slope[row_]));
    const V rise = hn::Mul(hn::Sub(height, line), inverse);
    const V rise_before = hn::Sub(hn::LoadU(d, before + i), line);
    const M same = hn::Lt(hn::Abs(hn::Sub(rise, rise_before)), hn::Set(d, s_.same_rise));
    const M near = hn::Or(same, hn::Le(distance, hn::Set(d, static_cast<float>(s_.marched_rows))));
    slope = hn::IfThenElse(near, hn::Set(d, std::numeric_limits<float>::lowest()), slope);
    if (with_others) slope = hn::Max(slope, hn::LoadU(d, slopes_ + i));
    hn::StoreU(slope, d, slopes_ + i);
  }

  void LookNear() {
    const D d;
    for (int n = 0; n < s_.near_count; ++n) {
      const NearSample& sample = s_.near[n];
      if (sample.back > row_ + s_.near_before) break;
      const float* HWY_RESTRICT a = Row(row_ - sample.back) + x0_ + sample.column;
      const float* HWY_RESTRICT b =
          sample.half ? Row(row_ - sample.back + 1) + x0_ + sample.column : a;
      const V fraction = hn::Set(d, sample.fraction), half = hn::Set(d, 0.5f);
      const V inverse = hn::Set(d, sample.inverse_distance), drop = hn::Set(d, sample.drop);
      for (int i = inner_first_; i < inner_last_; i += kLanes) {
        V left = hn::LoadU(d, a + i), right = hn::LoadU(d, a + i + 1);
        if (sample.half) {
          left = hn::Mul(half, hn::Add(left, hn::LoadU(d, b + i)));
          right = hn::Mul(half, hn::Add(right, hn::LoadU(d, b + i + 1)));
        }
        const V z = hn::MulAdd(fraction, hn::Sub(right, left), left);
        const V rise = hn::Sub(z, hn::LoadU(d, cells_ + x0_ + i));
        const V slope = hn::MulSub(rise, inverse, drop);
        hn::StoreU(hn::Max(slope, hn::LoadU(d, slopes_ + i)), d, slopes_ + i);
      }
    }
  }

  // The slope of the ground towards the horizon, and the cosine of its angle to the horizontal.
  HWY_INLINE void GroundSlope(int x, V* towards, V* cosine) const {
    const D d;
    const float* at = cells_ + x;
    const V z = hn::LoadU(d, at);
    const V across = NeighbourDifference(z, hn::LoadU(d, at - 1), hn::LoadU(d, at + 1));
    const V along =
        NeighbourDifference(z, hn::LoadU(d, at - s_.pitch), hn::LoadU(d, at + s_.pitch));
    *towards = hn::MulAdd(across, hn::Set(d, s_.towards_column),
                          hn::Mul(along, hn::Set(d, s_.towards_row)));
    const V p = hn::Mul(across, hn::Set(d, s_.inverse_width));
    const V q = hn::Mul(along, hn::Set(d, s_.inverse_height));
    *cosine = FastInverseSqrt(d, hn::MulAdd(p, p, hn::MulAdd(q, q, hn::Set(d, 1.0f))));
  }
  // Half the difference of the neighbours, or that to the only one with data.
  static HWY_INLINE V NeighbourDifference(V z, V before, V after) {
    const D d;
    const V none = hn::Set(d, 0.5f * kNoHeight);
    const M lacks_before = hn::Lt(before, none), lacks_after = hn::Lt(after, none);
    const V rise =
        hn::Sub(hn::IfThenElse(lacks_after, z, after), hn::IfThenElse(lacks_before, z, before));
    return hn::IfThenElse(hn::Or(lacks_before, lacks_after), rise, hn::Mul(rise, hn::Set(d, 0.5f)));
  }

  void AddSums() {
    const D d;
    const auto row = (s_.reversed ? s_.height - 1 - row_ : row_) * s_.pitch + x0_;
    auto add = [&](TerrainSum sum, int i, V value) HWY_ATTR {
      float* to = s_.sums[sum] + row + i;
      hn::StoreU(hn::Add(hn::LoadU(d, to), value), d, to);
    };
    for (int i = inner_first_; i < inner_last_; i += kLanes) {
      // A direction without data has the horizon 0.
      V slope = hn::LoadU(d, slopes_ + i);
      slope = hn::IfThenZeroElse(hn::Lt(slope, hn::Set(d, kNoSlope)), slope);
      const Horizon<D> above(d, hn::Max(slope, hn::Zero(d)));
      if (s_.sums[kSumSvf]) add(kSumSvf, i, above.OpenSky());
      if (s_.sums[kSumAsvf]) add(kSumAsvf, i, hn::Mul(hn::Set(d, s_.weight), above.OpenSky()));
      if (s_.sums[kSumSvfCosine]) add(kSumSvfCosine, i, above.OpenCosine());
      if (s_.sums[kSumVisibleSky]) add(kSumVisibleSky, i, above.Angle());
      if (s_.sums[kSumOpenness]) add(kSumOpenness, i, FastAtan(d, slope));
      if (s_.sums[kSumHorizon]) hn::StoreU(FastAtan(d, slope), d, s_.sums[kSumHorizon] + row + i);
      if (s_.sums[kSumSvfNormal]) {
        V towards, cosine;
        GroundSlope(x0_ + i, &towards, &cosine);
        const Horizon<D> highest(d, hn::Max(above.slope, towards));
        add(kSumSvfNormal, i, highest.OpenOnSlope(towards, cosine));
      }
    }
  }

  const TerrainSweep& s_;
  const int worker_;
  std::vector<LinePoint>& hull_;
  BlockPosition position_;
  Chains back_, forth_;
  float *lines_, *none_, *slopes_;
  int begin_ = 0;  // the first row in the grid
  int slot_of_row_0_ = 1;
  // Of the row at hand.
  int row_ = 0, slot_ = 0, x0_ = 0, first_ = 0, last_ = 0, inner_first_ = 0, inner_last_ = 0;
  const float* cells_ = nullptr;
  float offset_ = 0;
};

void SweepBlock(const TerrainSweep& sweep, int first_line, int worker, TerrainScratch* scratch) {
  Block(sweep, first_line, worker, scratch).Run();
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura {
HWY_EXPORT(SweepBlock);

void TerrainScratch::resize(int rows, bool windows) {
  const std::size_t row = kLines;
  horizon_points = LargeArray<float>(2 * row * (static_cast<std::size_t>(rows) + 1));
  // A row without data stands first.
  line_heights = LargeArray<float>(row * (1 + (windows ? static_cast<std::size_t>(rows) + 1 : 2)));
  block_points = LargeArray<float>(2 * row * (windows ? static_cast<std::size_t>(rows) + 1 : 1));
  slopes = LargeArray<float>(row);
}

int terrain_blocks(const TerrainSweep& s) {
  const double last = s.width - std::min(s.line(0), s.line(s.height - 1));
  const int lines = static_cast<int>(std::ceil(last)) + 1 - first_terrain_line(s);
  return (lines + kLines - 1) / kLines;
}

void sweep_terrain_block(const TerrainSweep& sweep, int block, int worker,
                         TerrainScratch* scratch) {
  const int line = first_terrain_line(sweep) + block * kLines;
  HWY_DYNAMIC_DISPATCH(SweepBlock)(sweep, line, worker, scratch);
}

}  // namespace obscura
#endif  // HWY_ONCE
