#ifndef OBSCURA_SRC_TERRAIN_SWEEP_KERNEL_H_
#define OBSCURA_SRC_TERRAIN_SWEEP_KERNEL_H_

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "core/large_array.h"
#include "obscura/terrain.h"

namespace obscura {

// Horizons along one azimuth. The grid is swept row by row, away from the side that the azimuth
// points to. Lines step one row at a time and move sideways by `shear` columns; each cell belongs
// to the line that passes nearest, so the lanes of a vector are neighbouring cells of a row.

// A cell without data. The value is finite, so that interpolation next to it stays a number, and
// far below any ground: no height exceeds 1e9.
inline constexpr float kNoHeight = -1e30f;
// Ends a chain of horizon points: higher than a cell without data, lower than any ground.
inline constexpr float kChainEnd = 0.5f * kNoHeight;
// Columns on either side of a grid and its sums, with kNoHeight. A grid has one such row above and
// one below, too.
inline constexpr int kTerrainMargin = 64;
// Lines that are swept together.
inline constexpr int kLinesLog2 = 7, kLines = 1 << kLinesLog2;
// The most rows that are marched sample by sample; so far sideways the margin reaches.
inline constexpr int kMostMarched = 24;

// A sample from the cell itself: `back` rows towards the horizon, between the columns `column` and
// `column` + 1 as counted from the cell's; `half`: the mean of this and of the same columns one row
// nearer.
struct NearSample {
  int back = 0, column = 0;
  float fraction = 0;
  bool half = false;
  float inverse_distance = 1;
  float drop = 0;  // what the curvature of the earth takes from the slope
};

// A point of a line; its swept row may lie before the grid's first.
using LinePoint = TerrainHullPoint;

// What lies on lines before they enter the grid, and what becomes of them when they leave it.
class LineEntries {
 public:
  virtual ~LineEntries() = default;
  // Of the line that is at column `column` + shear * row in any row, before `entry`, the row in
  // which it enters: the points of the upper hull as seen from there, nearest first.
  virtual std::span<const LinePoint> before(int column, int entry, int worker) = 0;
  // Whether lines are handed on that leave the grid behind its last row, or at its sides.
  virtual bool wants_last_row() const { return false; }
  virtual bool wants_sides() const { return false; }
  // Takes over a line whose last row in the grid is `row`: its point there, then the hull before.
  virtual void leave(int row, int x, std::span<const LinePoint> hull, int worker) {
    (void)row, (void)x, (void)hull, (void)worker;
  }
};

enum TerrainSum {
  kSumSvf,
  kSumSvfNormal,
  kSumSvfCosine,
  kSumOpenness,
  kSumVisibleSky,
  kSumAsvf,
  kSumHorizon,  // not a sum: the horizon of this azimuth alone
  kTerrainSums,
};

struct TerrainSweep {
  const float* heights = nullptr;  // of row 0, column 0
  std::ptrdiff_t pitch = 0;        // of heights and sums
  int width = 0, height = 0;
  bool reversed = false;  // from the last row to the first
  double shear = 0;
  // Swept rows from the first of the model that the grid is a part of: it has the same lines.
  int first_row = 0;
  float inverse_step = 1;  // 1 / distance from row to row along a line
  // By swept row, for a round earth: added to heights, and taken from slopes. Null: a flat one.
  const float *row_offset = nullptr, *row_slope = nullptr;
  const NearSample* near = nullptr;
  int near_count = 0;
  int near_before = 0;             // rows before the grid's first that they may read
  int marched_rows = 0;            // as far as these samples go
  float same_rise = 0;             // rises per row that differ by less are the same
  LineEntries* entries = nullptr;  // null: nothing lies before the grid; no window then
  int rows_before = 0;             // how far before the grid's first row it lies
  int window = 0;                  // rows that a line looks back; 0: samples only
  bool windows = false;            // whether that is less than the model has
  // The unit vector towards the horizon along columns and rows, each divided by the cell's side,
  // and 1 / the sides.
  float towards_column = 0, towards_row = 0;
  float inverse_width = 1, inverse_height = 1;
  float weight = 1;  // of this azimuth in kSumAsvf
  // The part of the grid whose cells are wanted: columns and rows from begin to end.
  int inner_column_begin = 0, inner_column_end = 0, inner_row_begin = 0, inner_row_end = 0;
  std::array<float*, kTerrainSums> sums{};  // of row 0, column 0; null: not wanted

  // Where line 0 is in a swept row.
  double line(int row) const { return shear * (first_row + row) - std::floor(shear * first_row); }
};

// Memory of a worker for one block of lines.
class TerrainScratch {
 public:
  // For grids of up to so many rows, with those before, and windows of any length if `windows`.
  void resize(int rows, bool windows);

  LargeArray<float> horizon_points;  // {height, slot} by row and line
  LargeArray<float> line_heights;
  LargeArray<float> block_points;  // as horizon_points, looking forth
  LargeArray<float> slopes;
  std::vector<LinePoint> hull;  // of a line that leaves
};

int terrain_blocks(const TerrainSweep& sweep);
void sweep_terrain_block(const TerrainSweep& sweep, int block, int worker, TerrainScratch* scratch);

}  // namespace obscura

#endif  // OBSCURA_SRC_TERRAIN_SWEEP_KERNEL_H_
