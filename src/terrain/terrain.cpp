#include "obscura/terrain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/guarded.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "terrain/check_terrain.h"
#include "terrain/directions.h"
#include "terrain/hand_over.h"
#include "terrain/local_dominance.h"
#include "terrain/passes.h"
#include "terrain/plane.h"
#include "terrain/surround.h"

namespace obscura {
namespace {

class Terrain {
 public:
  // `band`: null for a model as a whole, or a tile.
  Terrain(const ElevationModel& model, const TerrainBand* band, const TerrainSettings& settings,
          const TerrainOutputs& outputs, Executor& executor, const RunOptions& run)
      : model_(model),
        band_(band),
        settings_(settings),
        outputs_(outputs),
        executor_(executor),
        passes_(terrain_passes(outputs)),
        grid_(band ? inner_of(model)
                   : TerrainWindow{0, 0, model.heights.width, model.heights.height}),
        inner_(band ? TerrainWindow{0, 0, grid_.width, grid_.height} : inner_of(model)),
        place_(place_of(model, band)),
        first_row_(rows_are_whole() ? place_.row + grid_.y : 0),
        latitudes_(rows_are_whole()
                       ? terrain_latitudes(model, 0, place_.height)
                       : terrain_latitudes(model, inner_.y, inner_.y + inner_.height)) {
    std::int64_t work = 0;
    for (const TerrainLatitudes& l : latitudes_) {
      directions_.push_back(terrain_directions({place_.width, place_.height}, l.cell_width,
                                               model.cell_height, settings));
      for (TerrainDirection& d : directions_.back()) {
        cut_to_grid(&d);
        if (takes_part(l, d.up())) ++work;
      }
    }
    progress_.emplace(work * static_cast<std::int64_t>(passes_.size()), run.progress);
    reserve();
  }

  Status run() {
    int sweep = 0;
    for (const TerrainPass& pass : passes_) {
      for (std::size_t l = 0; l < latitudes_.size(); ++l) {
        if (Status s = run(pass, latitudes_[l], directions_[l], sweep); !s.ok()) return s;
        sweep += settings_.azimuths;
      }
    }
    return {};
  }

 private:
  // The whole model, and where in it the heights lie.
  struct Place {
    int width, height, column, row;
  };
  static Place place_of(const ElevationModel& model, const TerrainBand* band) {
    if (band) return {model.heights.width, band->height, 0, band->row};
    const TerrainSurround& s = model.surround;
    if (s.width == 0) return {model.heights.width, model.heights.height, 0, 0};
    return {static_cast<int>(s.width), static_cast<int>(s.height), static_cast<int>(s.column),
            static_cast<int>(s.row)};
  }
  // Whether rows of latitudes are those of the whole model.
  bool rows_are_whole() const {
    return band_ || model_.row_widths.size() == static_cast<std::size_t>(place_.height);
  }
  int rows_above() const { return band_ ? grid_.y : 0; }
  int rows_below() const { return band_ ? model_.heights.height - grid_.y - grid_.height : 0; }
  // Rows of the grid where these latitudes' results are wanted.
  int begin_of(const TerrainLatitudes& l) const { return std::max(l.begin - first_row_, inner_.y); }
  int end_of(const TerrainLatitudes& l) const {
    return std::min(l.end - first_row_, inner_.y + inner_.height);
  }
  // Whether lines run through the grid to these latitudes, and whether they go on behind it.
  bool takes_part(const TerrainLatitudes& l, bool up) const {
    if (!band_) return begin_of(l) < end_of(l);
    return up == band_->up && (up ? l.begin < first_row_ + grid_.height : l.end > first_row_);
  }
  bool goes_on(const TerrainLatitudes& l, bool up) const {
    return up ? l.begin < first_row_ : l.end > first_row_ + grid_.height;
  }

  // A direction over the whole model becomes one over the grid.
  void cut_to_grid(TerrainDirection* d) const {
    TerrainSweep& s = d->sweep;
    s.windows = s.window > 0 && s.window < d->whole_rows;
    const Extent size = {grid_.width, grid_.height};
    const int column = place_.column + grid_.x, row = place_.row + grid_.y;
    s.width = d->transposed ? size.height : size.width;
    s.height = d->transposed ? size.width : size.height;
    const int before = d->transposed ? column : row;
    s.first_row = s.reversed ? d->whole_rows - before - s.height : before;
    if (!band_) {
      if (!model_.surround.heights.empty()) s.rows_before = s.first_row;
    } else {
      s.rows_before = s.first_row;
      if (!d->transposed) s.near_before = s.reversed ? rows_below() : rows_above();
    }
  }

  // All memory is taken before an output is touched.
  void reserve() {
    const int margin = std::max({1, rows_above(), rows_below()});
    auto take = [&](TerrainPlane& plane, int rows) {
      plane.resize(grid_.width, grid_.height, rows);
      plane.resize(grid_.height, grid_.width);
    };
    take(heights_, margin);
    std::size_t planes = 0;
    for (const TerrainPass& p : passes_) {
      planes = std::max(planes, p.wanted.size() + (p.horizon ? 1 : 0));
    }
    sums_.resize(planes);
    for (TerrainPlane& plane : sums_) take(plane, 1);
    scratch_.resize(executor_.thread_count());
    bool windows = false;
    int rows = std::max(grid_.width, grid_.height);
    for (auto& directions : directions_) {
      for (TerrainDirection& d : directions) {
        rows = std::max(rows, d.sweep.height + d.sweep.rows_before);
        windows = windows || d.sweep.windows;
      }
    }
    for (TerrainScratch& s : scratch_) s.resize(rows, windows);
    points_.resize(executor_.thread_count());
    for (auto& points : points_) {
      if (!model_.surround.heights.empty()) points.reserve(rows / model_.surround.factor + 2);
    }
  }

  Status run(const TerrainPass& pass, const TerrainLatitudes& latitudes,
             const std::vector<TerrainDirection>& directions, int first_sweep) {
    const bool results = begin_of(latitudes) < end_of(latitudes);
    int prepared = -1;
    for (const TerrainStep& step : kTerrainSteps) {
      if (!takes_part(latitudes, step.up)) continue;
      if (prepared != int{step.transposed}) prepare_heights(pass, step.transposed);
      prepared = step.transposed;
      prepare_sums(pass, step.transposed);
      if (pass.dominance && step.first && results) find_dominance(latitudes);
      for (const TerrainDirection& d : directions) {
        if (d.transposed != step.transposed || d.up() != step.up) continue;
        if (pass.sweeps()) {
          if (Status s = sweep(pass, latitudes, d, first_sweep + d.index); !s.ok()) return s;
        }
        if (!progress_->advance()) {
          return {StatusCode::kCancelled, "the terrain sweep was cancelled by the caller"};
        }
      }
      for (std::size_t i = 0; i < pass.wanted.size() && results; ++i) {
        fold(sums_[i], pass.wanted[i], latitudes, step);
      }
    }
    return {};
  }

  // The model's heights with margins, relative to its datum.
  void prepare_heights(const TerrainPass& pass, bool transposed) {
    const int above = rows_above(), below = rows_below();
    if (transposed) {
      heights_.resize(grid_.height, grid_.width);
    } else {
      heights_.resize(grid_.width, grid_.height, std::max({1, above, below}));
    }
    const int margin = heights_.margin();
    executor_.parallel_for(heights_.height() + 2 * margin,
                           [&](int row, int) { heights_.fill_row(row - margin, kNoHeight); });
    const double factor = pass.sign * settings_.z_factor;
    // Rows around a band are margins, of columns where it is transposed.
    for_tiles({grid_.width, above + grid_.height + below}, executor_,
              [&](int x0, int y0, int x1, int y1) {
                TileBuffer tile;
                for (int y = y0; y < y1; ++y) {
                  float* to = transposed ? tile.row(y - y0) : heights_.row(y - above) + x0;
                  for (int x = x0; x < x1; ++x) {
                    const float height = model_.heights(x, grid_.y - above + y);
                    const auto value = static_cast<float>(factor * (double{height} - datum_));
                    to[x - x0] = has_height(model_, height) ? value : kNoHeight;
                  }
                }
                if (!transposed) return;
                for (int x = x0; x < x1; ++x) {
                  float* to = heights_.row(x) - above;
                  for (int y = y0; y < y1; ++y) to[y] = tile.row(y - y0)[x - x0];
                }
              });
  }

  void prepare_sums(const TerrainPass& pass, bool transposed) {
    const Extent size =
        transposed ? Extent{grid_.height, grid_.width} : Extent{grid_.width, grid_.height};
    for (TerrainPlane& plane : sums_) plane.resize(size.width, size.height);
    executor_.parallel_for(size.height + 2, [&](int row, int) {
      for (std::size_t i = 0; i < pass.wanted.size(); ++i) sums_[i].fill_row(row - 1, 0.0f);
    });
  }

  Status sweep(const TerrainPass& pass, const TerrainLatitudes& latitudes,
               const TerrainDirection& direction, int number) {
    TerrainSweep s = direction.sweep;
    s.heights = heights_.row(0);
    s.pitch = heights_.pitch();
    s.near = direction.near.data();
    s.near_count = static_cast<int>(direction.near.size());
    if (!direction.row_offset.empty()) {
      s.row_offset = direction.row_offset.data() + s.first_row;
      s.row_slope = direction.row_slope.data() + s.first_row;
    }
    for (std::size_t i = 0; i < pass.wanted.size(); ++i) {
      s.sums[pass.wanted[i].sum] = sums_[i].row(0);
    }
    if (pass.horizon) s.sums[kSumHorizon] = sums_[pass.wanted.size()].row(0);
    const int begin = begin_of(latitudes), end = end_of(latitudes);
    const int left = inner_.x, right = inner_.x + inner_.width;
    s.inner_column_begin = direction.transposed ? begin : left;
    s.inner_column_end = direction.transposed ? end : right;
    s.inner_row_begin = direction.transposed ? left : begin;
    s.inner_row_end = direction.transposed ? right : end;
    SurroundLines surround(model_, direction, pass.sign * settings_.z_factor, datum_, &points_);
    if (!model_.surround.heights.empty()) s.entries = &surround;
    const bool hulls = band_ && s.window > 0;
    HandOver hand_over(direction, hulls ? band_->from : nullptr,
                       hulls && goes_on(latitudes, direction.up()) ? band_->to : nullptr, &points_);
    if (hulls) {
      s.entries = &hand_over;
      for (TerrainHulls* h : {band_->from, band_->to}) {
        if (!h) continue;
        if (Status begun = h->begin(number); !begun.ok()) return begun;
      }
    }
    executor_.parallel_for(terrain_blocks(s), [&](int block, int worker) {
      sweep_terrain_block(s, block, worker, &scratch_[worker]);
    });
    if (pass.horizon && begin < end) {
      constexpr double kDegrees = 180 / std::numbers::pi;
      fold(sums_[pass.wanted.size()],
           {kSumHorizon, outputs_.horizon[direction.index], 0, settings_.azimuths * kDegrees, -90,
            90},
           latitudes, {direction.transposed, direction.up(), true, true});
    }
    return hand_over.status();
  }

  // Calls body(x0, y0, x1, y1) for tiles of the latitudes' results, in cells of the grid.
  template <class Body>
  void for_results(const TerrainLatitudes& latitudes, Body&& body) {
    const int begin = begin_of(latitudes);
    for_tiles({inner_.width, end_of(latitudes) - begin}, executor_,
              [&](int x0, int y0, int x1, int y1) {
                body(x0 + inner_.x, y0 + begin, x1 + inner_.x, y1 + begin);
              });
  }
  bool has_height_at(int x, int y) const {
    return has_height(model_, model_.heights(x, y + grid_.y));
  }

  void find_dominance(const TerrainLatitudes& latitudes) {
    const ImageView<float>& out = outputs_.local_dominance;
    for_results(latitudes, [&](int x0, int y0, int x1, int y1) {
      for (int y = y0; y < y1; ++y) {
        float dominance[kTerrainTile];
        ring_.row(heights_, y, x0, x1, dominance);
        for (int x = x0; x < x1; ++x) {
          out(x - inner_.x, y - inner_.y) =
              has_height_at(x, y) ? dominance[x - x0] : std::numeric_limits<float>::quiet_NaN();
        }
      }
    });
  }

  // Adds sums to an output, which the first step starts and the last one ends.
  void fold(const TerrainPlane& sums, const TerrainWanted& wanted,
            const TerrainLatitudes& latitudes, const TerrainStep& step) {
    const auto factor = static_cast<float>(wanted.factor / settings_.azimuths);
    const auto start = static_cast<float>(wanted.start);
    const auto least = static_cast<float>(wanted.least), most = static_cast<float>(wanted.most);
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    auto fold_row = [&](int y, int x0, int x1, const float* sum) {
      for (int x = x0; x < x1; ++x) {
        float& out = wanted.view(x - inner_.x, y - inner_.y);
        float value = (step.first ? start : out) + factor * sum[x - x0];
        if (step.last) value = std::clamp(value, least, most);
        out = has_height_at(x, y) ? value : kNone;
      }
    };
    for_results(latitudes, [&](int x0, int y0, int x1, int y1) {
      TileBuffer tile;
      for (int x = x0; step.transposed && x < x1; ++x) {
        for (int y = y0; y < y1; ++y) tile.row(y - y0)[x - x0] = sums.row(x)[y];
      }
      for (int y = y0; y < y1; ++y) {
        fold_row(y, x0, x1, step.transposed ? tile.row(y - y0) : sums.row(y) + x0);
      }
    });
  }

  const ElevationModel& model_;
  const TerrainBand* const band_;
  const TerrainSettings& settings_;
  const TerrainOutputs& outputs_;
  Executor& executor_;
  const std::vector<TerrainPass> passes_;
  const TerrainWindow grid_;   // that lines run through, in cells of the heights
  const TerrainWindow inner_;  // where results are wanted, in cells of the grid
  const Place place_;
  const int first_row_;  // of latitudes, which is the grid's first
  const std::vector<TerrainLatitudes> latitudes_;
  std::vector<std::vector<TerrainDirection>> directions_;  // by latitudes
  const DominanceRing ring_{settings_};
  std::optional<Progress> progress_;
  const double datum_ = model_.datum ? *model_.datum : first_height(model_);
  TerrainPlane heights_;
  std::vector<TerrainPlane> sums_;  // in the order of a pass's quantities; the horizon is last
  std::vector<TerrainScratch> scratch_;
  HandOver::Points points_;
};

}  // namespace

Status compute_terrain(const ElevationModel& model, const TerrainSettings& settings,
                       const TerrainOutputs& outputs, const RunOptions& run) {
  return guarded("the terrain sweep; use a smaller model", [&]() -> Status {
    if (Status s = check_terrain(model, settings, outputs); !s.ok()) return s;
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    return Terrain(model, nullptr, settings, outputs, threads.executor(), run).run();
  });
}

Status compute_terrain_band(const ElevationModel& model, const TerrainBand& band,
                            const TerrainSettings& settings, const TerrainOutputs& outputs,
                            const RunOptions& run) {
  return guarded("the terrain sweep; use narrower bands", [&]() -> Status {
    if (Status s = check_terrain_band(model, band, settings, outputs); !s.ok()) return s;
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    return Terrain(model, &band, settings, outputs, threads.executor(), run).run();
  });
}

}  // namespace obscura
