#include "obscura/terrain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/guarded.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "terrain/check_terrain.h"
#include "terrain/directions.h"
#include "terrain/local_dominance.h"
#include "terrain/plane.h"
#include "terrain/surround.h"

namespace obscura {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// A quantity is start + factor * the mean over the azimuths of its sum's terms, in [least, most].
struct Wanted {
  TerrainSum sum;
  ImageView<float> view;
  double start, factor, least, most;
};

// A pass over the model as it is, or turned upside down.
struct Pass {
  float sign = 1;
  std::vector<Wanted> wanted;
  bool horizon = false, dominance = false;

  bool sweeps() const { return horizon || !wanted.empty(); }
};

std::vector<Pass> make_passes(const TerrainOutputs& o) {
  Pass up, down;
  down.sign = -1;
  auto want = [](Pass& pass, TerrainSum sum, const ImageView<float>& view, double start,
                 double factor, double most) {
    if (!view.empty()) pass.wanted.push_back({sum, view, start, factor, 0, most});
  };
  want(up, kSumSvf, o.svf, 0, 1, 1);
  want(up, kSumSvfNormal, o.svf_normal, 0, 1, 1);
  want(up, kSumSvfCosine, o.svf_cosine, 0, 1, 1);
  want(up, kSumOpenness, o.openness, 90, -kDegrees, 180);
  want(up, kSumVisibleSky, o.visible_sky, 100, -100 * 2 / std::numbers::pi, 100);
  want(up, kSumAsvf, o.asvf, 0, 1, 1);
  up.horizon = !o.horizon.empty();
  up.dominance = !o.local_dominance.empty();
  want(down, kSumOpenness, o.negative_openness, 90, -kDegrees, 180);
  std::vector<Pass> passes;
  if (up.dominance || up.sweeps()) passes.push_back(std::move(up));
  if (!down.wanted.empty()) passes.push_back(std::move(down));
  return passes;
}

// Wanted rows whose cells are taken to be as wide as each other.
struct Band {
  int begin, end;
  double cell_width;
};

std::vector<Band> make_bands(const ElevationModel& model) {
  const TerrainWindow inner = inner_of(model);
  const int height = inner.y + inner.height;
  if (model.row_widths.empty()) return {{inner.y, height, model.cell_width}};
  constexpr double kSpread = 1.02;
  std::vector<Band> bands;
  for (int y = inner.y; y < height;) {
    double least = model.row_widths[y], most = least;
    int end = y;
    for (; end < height; ++end) {
      const double low = std::min(least, model.row_widths[end]);
      const double high = std::max(most, model.row_widths[end]);
      if (high > kSpread * low) break;
      least = low;
      most = high;
    }
    bands.push_back({y, end, 0.5 * (least + most)});
    y = end;
  }
  return bands;
}

class Terrain {
 public:
  Terrain(const ElevationModel& model, const TerrainSettings& settings,
          const TerrainOutputs& outputs, Executor& executor, const RunOptions& run)
      : model_(model),
        settings_(settings),
        outputs_(outputs),
        executor_(executor),
        passes_(make_passes(outputs)),
        bands_(make_bands(model)),
        progress_(static_cast<std::int64_t>(passes_.size() * bands_.size() * settings.azimuths),
                  run.progress) {
    for (const Band& band : bands_) {
      directions_.push_back(terrain_directions(model, band.cell_width, settings));
    }
    // All memory is taken before an output is touched.
    const Extent size = {model.heights.width, model.heights.height};
    auto reserve = [&](TerrainPlane& plane) {
      plane.resize(size.width, size.height);
      plane.resize(size.height, size.width);
    };
    reserve(heights_);
    std::size_t planes = 0;
    for (const Pass& p : passes_) {
      planes = std::max(planes, p.wanted.size() + (p.horizon ? 1 : 0));
    }
    sums_.resize(planes);
    for (TerrainPlane& plane : sums_) reserve(plane);
    scratch_.resize(executor.thread_count());
    bool windows = false;
    int before = 0;
    for (auto& directions : directions_) {
      for (TerrainDirection& d : directions) {
        d.sweep.rows_before = SurroundLines::rows_before(model, d);
        d.sweep.first_row = d.sweep.rows_before;
        before = std::max(before, d.sweep.rows_before);
        windows = windows || (d.sweep.window > 0 && d.sweep.window < d.sweep.height);
      }
    }
    const int rows = std::max(size.width, size.height) + before;
    for (TerrainScratch& s : scratch_) s.resize(rows, windows);
    surround_points_.resize(executor.thread_count());
    for (auto& points : surround_points_) {
      if (before > 0) points.reserve(rows / model.surround.factor + 2);
    }
  }

  Status run() {
    for (const Pass& pass : passes_) {
      for (std::size_t b = 0; b < bands_.size(); ++b) {
        if (!run(pass, bands_[b], directions_[b])) {
          return {StatusCode::kCancelled, "the terrain sweep was cancelled by the caller"};
        }
      }
    }
    return {};
  }

 private:
  bool run(const Pass& pass, const Band& band, const std::vector<TerrainDirection>& directions) {
    for (const bool transposed : {false, true}) {
      prepare(pass, transposed);
      if (pass.dominance && !transposed) find_dominance(band);
      for (const TerrainDirection& direction : directions) {
        if (direction.transposed != transposed) continue;
        if (pass.sweeps()) sweep(pass, band, direction);
        if (!progress_.advance()) return false;
      }
      for (std::size_t i = 0; i < pass.wanted.size(); ++i) {
        fold(sums_[i], pass.wanted[i], band, transposed);
      }
    }
    return true;
  }

  // The model's heights with margins, relative to its first cell, and sums of zero.
  void prepare(const Pass& pass, bool transposed) {
    const Extent size = {model_.heights.width, model_.heights.height};
    const int columns = transposed ? size.height : size.width;
    const int rows = transposed ? size.width : size.height;
    heights_.resize(columns, rows);
    for (TerrainPlane& plane : sums_) plane.resize(columns, rows);
    executor_.parallel_for(rows + 2, [&](int row, int) {
      heights_.fill_row(row - 1, kNoHeight);
      for (std::size_t i = 0; i < pass.wanted.size(); ++i) sums_[i].fill_row(row - 1, 0.0f);
    });
    const double factor = pass.sign * settings_.z_factor;
    for_tiles(size, executor_, [&](int x0, int y0, int x1, int y1) {
      TileBuffer tile;
      for (int y = y0; y < y1; ++y) {
        float* to = transposed ? tile.row(y - y0) : heights_.row(y) + x0;
        for (int x = x0; x < x1; ++x) {
          const float height = model_.heights(x, y);
          const auto value = static_cast<float>(factor * (double{height} - base_));
          to[x - x0] = has_height(model_, height) ? value : kNoHeight;
        }
      }
      if (!transposed) return;
      for (int x = x0; x < x1; ++x) {
        for (int y = y0; y < y1; ++y) heights_.row(x)[y] = tile.row(y - y0)[x - x0];
      }
    });
  }

  void sweep(const Pass& pass, const Band& band, const TerrainDirection& direction) {
    TerrainSweep s = direction.sweep;
    s.heights = heights_.row(0);
    s.pitch = heights_.pitch();
    s.near = direction.near.data();
    s.near_count = static_cast<int>(direction.near.size());
    if (!direction.row_offset.empty()) {
      s.row_offset = direction.row_offset.data();
      s.row_slope = direction.row_slope.data();
    }
    for (std::size_t i = 0; i < pass.wanted.size(); ++i) {
      s.sums[pass.wanted[i].sum] = sums_[i].row(0);
    }
    if (pass.horizon) s.sums[kSumHorizon] = sums_[pass.wanted.size()].row(0);
    s.inner_column_begin = direction.transposed ? inner_.y : inner_.x;
    s.inner_column_end =
        s.inner_column_begin + (direction.transposed ? inner_.height : inner_.width);
    s.inner_row_begin = direction.transposed ? inner_.x : inner_.y;
    s.inner_row_end = s.inner_row_begin + (direction.transposed ? inner_.width : inner_.height);
    SurroundLines surround(model_, direction, pass.sign * settings_.z_factor, base_,
                           &surround_points_);
    if (!model_.surround.heights.empty()) s.entries = &surround;
    executor_.parallel_for(terrain_blocks(s), [&](int block, int worker) {
      sweep_terrain_block(s, block, worker, &scratch_[worker]);
    });
    if (pass.horizon) {
      fold(sums_[pass.wanted.size()],
           {kSumHorizon, outputs_.horizon[direction.index], 0, settings_.azimuths * kDegrees, -90,
            90},
           band, direction.transposed, true);
    }
  }

  void find_dominance(const Band& band) {
    const ImageView<float>& out = outputs_.local_dominance;
    for_tiles({inner_.width, band.end - band.begin}, executor_,
              [&](int x0, int y0, int x1, int y1) {
                for (int y = band.begin + y0; y < band.begin + y1; ++y) {
                  float dominance[kTerrainTile];
                  ring_.row(heights_, y, inner_.x + x0, inner_.x + x1, dominance);
                  for (int x = x0; x < x1; ++x) {
                    const bool has = has_height(model_, model_.heights(inner_.x + x, y));
                    out(x, y - inner_.y) =
                        has ? dominance[x - x0] : std::numeric_limits<float>::quiet_NaN();
                  }
                }
              });
  }

  // Adds sums to an output. The first of the two grids starts it, the second ends it; `whole`: one
  // is all.
  void fold(const TerrainPlane& sums, const Wanted& wanted, const Band& band, bool transposed,
            bool whole = false) {
    const auto factor = static_cast<float>(wanted.factor / settings_.azimuths);
    const auto start = static_cast<float>(wanted.start);
    const auto least = static_cast<float>(wanted.least), most = static_cast<float>(wanted.most);
    const bool first = whole || !transposed, last = whole || transposed;
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    auto fold_row = [&](int y, int x0, int x1, const float* sum) {
      for (int x = x0; x < x1; ++x) {
        float& out = wanted.view(x - inner_.x, y - inner_.y);
        float value = (first ? start : out) + factor * sum[x - x0];
        if (last) value = std::clamp(value, least, most);
        out = has_height(model_, model_.heights(x, y)) ? value : kNone;
      }
    };
    for_tiles({inner_.width, band.end - band.begin}, executor_,
              [&](int x0, int y0, int x1, int y1) {
                x0 += inner_.x;
                x1 += inner_.x;
                y0 += band.begin;
                y1 += band.begin;
                TileBuffer tile;
                for (int x = x0; transposed && x < x1; ++x) {
                  for (int y = y0; y < y1; ++y) tile.row(y - y0)[x - x0] = sums.row(x)[y];
                }
                for (int y = y0; y < y1; ++y) {
                  fold_row(y, x0, x1, transposed ? tile.row(y - y0) : sums.row(y) + x0);
                }
              });
  }

  const ElevationModel& model_;
  const TerrainSettings& settings_;
  const TerrainOutputs& outputs_;
  Executor& executor_;
  const std::vector<Pass> passes_;
  const std::vector<Band> bands_;
  std::vector<std::vector<TerrainDirection>> directions_;  // by band
  const DominanceRing ring_{settings_};
  Progress progress_;
  const double base_ = first_height(model_);
  const TerrainWindow inner_ = inner_of(model_);
  TerrainPlane heights_;
  std::vector<TerrainPlane> sums_;  // in the order of a pass's quantities; the horizon is last
  std::vector<TerrainScratch> scratch_;
  SurroundLines::Points surround_points_;
};

}  // namespace

Status compute_terrain(const ElevationModel& model, const TerrainSettings& settings,
                       const TerrainOutputs& outputs, const RunOptions& run) {
  return guarded("the terrain sweep; use a smaller model", [&]() -> Status {
    if (Status s = check_terrain(model, settings, outputs); !s.ok()) return s;
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    return Terrain(model, settings, outputs, threads.executor(), run).run();
  });
}

}  // namespace obscura
