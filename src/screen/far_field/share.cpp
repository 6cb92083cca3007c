#include "screen/far_field/share.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

#include "math/leaf_scalar.h"
#include "screen/far_field/share_kernel.h"

namespace obscura {
namespace leaf_scalar {
#include "screen/far_field/share_leaf.h"
}  // namespace leaf_scalar

namespace far_field {
namespace {

constexpr int kRowsPerTask = 8;

// The job for pixels from x0 on of row y, up to x_end, with three rows of the geometry.
void load_surface(const view::Geometry& g, int side, int x0, int y, int x_end, ShareJob* job) {
  const int width = g.visible().width, height = g.visible().height;
  const int left = g.guard_band.left, top = g.guard_band.top;
  job->side = side;
  job->count = std::min(ShareJob::kMaxCount, x_end - x0);
  job->view = {
      .scale_x = g.camera.scale_x, .scale_y = g.camera.scale_y, .parallel = g.camera.orthographic};
  job->axis_x = static_cast<float>(x0 + left) + 0.5f - g.camera.center_u;
  job->axis_y = static_cast<float>(y + top) + 0.5f - g.camera.center_v;
  const AlignedImage<float>* normal[] = {&g.normal_x, &g.normal_y, &g.normal_z};
  for (int k = 0; k < 3; ++k) {
    const int ny = y + k - 1;
    ShareJob::Row& row = job->rows[k];
    if (ny < 0 || ny >= height) {
      // Without depth it has no weight.
      std::fill_n(row.depth, job->count + 2, std::numeric_limits<float>::infinity());
      continue;
    }
    const int first = std::max(x0 - 1, 0), end = std::min(x0 + job->count + 1, width);
    row.depth[0] = row.depth[job->count + 1] = std::numeric_limits<float>::infinity();
    auto copy = [&](const AlignedImage<float>& from, float* to) {
      std::copy_n(from.row(ny + top) + left + first, end - first, to + first - x0 + 1);
    };
    copy(g.depth, row.depth);
    for (int c = 0; c < 3; ++c) copy(*normal[c], row.normal[c]);
  }
}

}  // namespace

void SharedWork::prepare(const view::Geometry& g, Executor& executor) {
  const int width = g.visible().width, height = g.visible().height;
  const int columns = (width + tile_ - 1) / tile_, rows = (height + tile_ - 1) / tile_;
  dense_[0].resize(columns, rows);
  dense_[1].resize(rows, columns);
  executor.parallel_for(rows, [&](int ty, int) {
    ShareJob job;
    std::uint8_t* dense = dense_[0].row(ty);
    for (int tx = 0; tx < columns; ++tx) {
      const int x_end = std::min(width, (tx + 1) * tile_);
      std::int64_t known = 0, all = 0;
      for (int y = ty * tile_; y < std::min(height, (ty + 1) * tile_); y += kKnownStep) {
        for (int x0 = tx * tile_; x0 < x_end; x0 += ShareJob::kMaxCount) {
          load_surface(g, side_, x0, y, x_end, &job);
          find_known(&job);
          known = std::accumulate(job.known, job.known + job.count, known);
          all += std::int64_t{leaf_scalar::kKnownUnits} * side_ * side_ * job.count;
        }
      }
      dense[tx] = static_cast<float>(known) < leaf_scalar::kEnough * static_cast<float>(all);
      dense_[1](ty, tx) = dense[tx];
    }
  });
}

SharedWork::Who SharedWork::evaluates(int cell, int share) const {
  const int own = leaf_scalar::share_of_cell(cell / side_, cell % side_, side_);
  if (leaf_scalar::has_share(own, share, side_, false)) return Who::kAll;
  return leaf_scalar::has_share(own, share, side_, true) ? Who::kDense : Who::kNone;
}

void SharedWork::gather(const view::Geometry& g, const WantedSums& wanted, Executor& executor,
                        Totals* totals, Totals* spare) const {
  const int width = g.visible().width, height = g.visible().height;
  const std::vector<Channel> channels = wanted.channels();
  for (Channel c : channels) spare->channel[c].resize(width, height);
  executor.parallel_for((height + kRowsPerTask - 1) / kRowsPerTask, [&](int task, int) {
    const float many = static_cast<float>(side_);
    ShareJob job;
    job.channels = static_cast<int>(channels.size());
    for (int y = task * kRowsPerTask; y < std::min(height, (task + 1) * kRowsPerTask); ++y) {
      for (int x0 = 0; x0 < width; x0 += ShareJob::kMaxCount) {
        load_surface(g, side_, x0, y, width, &job);
        const int first = std::max(x0 - 1, 0), end = std::min(x0 + job.count + 1, width);
        for (int k = 0; k < 3; ++k) {
          const int ny = std::clamp(y + k - 1, 0, height - 1);
          const std::uint8_t* dense = dense_[0].row(ny / tile_);
          for (int x = first; x < end; ++x) {
            job.rows[k].shares[x - x0 + 1] = dense[x / tile_] ? many : 1.0f;
          }
          for (int c = 0; c < job.channels; ++c) {
            std::copy_n(totals->channel[channels[c]].row(ny) + first, end - first,
                        job.rows[k].sums[c] + first - x0 + 1);
          }
        }
        for (int c = 0; c < job.channels; ++c) job.out[c] = spare->channel[channels[c]].row(y) + x0;
        share_row(&job);
      }
    }
  });
  for (Channel c : channels) std::swap(totals->channel[c], spare->channel[c]);
}

}  // namespace far_field
}  // namespace obscura
