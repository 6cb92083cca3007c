#include "view/widths.h"

#include <algorithm>
#include <limits>

#include "math/leaf_scalar.h"

namespace obscura {
namespace leaf_scalar {
#include "view/widths_leaf.h"
}  // namespace leaf_scalar

namespace view {
namespace {

constexpr int kColumnsPerTask = 64;

// Of columns [begin, end): down[] is the run on both sides, the texel included.
void run_down(const Geometry& g, int begin, int end, AlignedImage<float>* down) {
  const float scale = g.camera.scale_y;
  const bool parallel = g.camera.orthographic;
  auto joined = [&](int x, int y) {  // of rows y and y + 1
    return leaf_scalar::joined_part(g.depth(x, y), g.depth(x, y + 1), scale, parallel);
  };
  for (int x = begin; x < end; ++x) (*down)(x, 0) = 0;
  for (int y = 1; y < g.height; ++y) {
    for (int x = begin; x < end; ++x) {
      (*down)(x, y) = leaf_scalar::run_beside((*down)(x, y - 1), joined(x, y - 1));
    }
  }
  float below[kColumnsPerTask] = {};
  for (int y = g.height - 1; y >= 0; --y) {
    for (int x = begin; x < end; ++x) {
      float& run = below[x - begin];
      run = y + 1 < g.height ? leaf_scalar::run_beside(run, joined(x, y)) : 0;
      (*down)(x, y) += 1 + run;
    }
  }
}

// Of one row: across[] likewise.
void run_across(const Geometry& g, int y, float* across) {
  const float* depth = g.depth.row(y);
  const float scale = g.camera.scale_x;
  const bool parallel = g.camera.orthographic;
  auto joined = [&](int x) {  // of columns x and x + 1
    return leaf_scalar::joined_part(depth[x], depth[x + 1], scale, parallel);
  };
  across[0] = 0;
  for (int x = 1; x < g.width; ++x) {
    across[x] = leaf_scalar::run_beside(across[x - 1], joined(x - 1));
  }
  float right = 0;
  for (int x = g.width - 1; x >= 0; --x) {
    if (x + 1 < g.width) right = leaf_scalar::run_beside(right, joined(x));
    across[x] += 1 + right;
  }
}

}  // namespace

void back_from_widths(Executor& executor, Geometry* geometry) {
  Geometry& g = *geometry;
  g.back_depth.resize(g.width, g.height);
  g.runs.resize(g.width, g.height);
  executor.parallel_for((g.width + kColumnsPerTask - 1) / kColumnsPerTask, [&](int task, int) {
    const int begin = task * kColumnsPerTask;
    run_down(g, begin, std::min(g.width, begin + kColumnsPerTask), &g.back_depth);
  });
  executor.parallel_for(g.height, [&](int y, int) {
    float* across = g.runs.row(y);
    run_across(g, y, across);
    const float* depth = g.depth.row(y);
    float* back = g.back_depth.row(y);
    for (int x = 0; x < g.width; ++x) {
      back[x] = leaf_scalar::back_of_runs(depth[x], across[x], back[x], g.camera.scale_x,
                                          g.camera.scale_y, g.camera.orthographic);
    }
  });
}

}  // namespace view
}  // namespace obscura
