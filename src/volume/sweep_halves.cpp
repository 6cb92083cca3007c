#include "volume/sweep_halves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "volume/volume_access.h"

namespace obscura {

void set_occlusion_grid(const GridView<const float>& distance, const OcclusionSettings& settings,
                        VisibilityFieldImpl* field) {
  VisibilityFieldImpl& f = *field;
  f.transport = settings.transport;
  f.scheme = transport_scheme(settings.transport, distance.spacing);
  f.alpha = settings.alpha;
  const int cell = f.scheme.cell;
  for (int a = 0; a < 3; ++a) {
    f.size[a] = (distance.size[a] + cell - 1) / cell;
    f.spacing[a] = cell * distance.spacing[a];
    f.origin[a] = 0.5f * static_cast<float>(cell - 1) * distance.spacing[a];
    // The last voxel of an odd number reaches beyond the border.
    f.end[a] = static_cast<float>(distance.size[a] - 1) * distance.spacing[a] - f.origin[a];
  }
}

float occlusion_unit(const VisibilityFieldImpl& field) {
  return std::cbrt(field.spacing[0]) * std::cbrt(field.spacing[1]) * std::cbrt(field.spacing[2]);
}

void occlusion_tau(const GridView<const float>& distance, const VisibilityFieldImpl& f,
                   Executor& executor, std::uint8_t* tau) {
  const int cell = f.scheme.cell;
  const auto stride = distance.strides();
  const float scale = 1 / (occlusion_unit(f) * static_cast<float>(cell * cell * cell));
  executor.parallel_for(f.size[2], [&](int z, int) {
    for (int y = 0; y < f.size[1]; ++y) {
      const float* rows[4];
      int count = 0;
      for (int k = 0; k < cell; ++k) {
        for (int j = 0; j < cell; ++j) {
          rows[count++] = distance.data + std::min(z * cell + k, distance.size[2] - 1) * stride[2] +
                          std::min(y * cell + j, distance.size[1] - 1) * stride[1];
        }
      }
      transmittance_row(rows, count, stride[0], distance.size[0], cell, scale, f.alpha,
                        tau + static_cast<std::size_t>(f.size[0]) *
                                  (y + static_cast<std::size_t>(f.size[1]) * z));
    }
  });
}

void sweep_halves(const std::uint8_t* tau, const OcclusionSettings& settings, int halves,
                  Executor& executor, Progress& progress, VisibilityFieldImpl* field) {
  const std::size_t samples = field->voxels() * field->channels();
  const SweepDirection* directions = field->scheme.directions.data();
  if (settings.precision == VisibilityPrecision::kU8) {
    for (int half = 0; half < 2; ++half) {
      if ((halves >> half & 1) && !field->bytes[half]) {
        field->bytes[half].reset(new std::uint8_t[samples]);
      }
    }
    std::vector<OcclusionSweep> sweeps;
    for (int half = 0; half < 2; ++half) {
      if (!(halves >> half & 1)) continue;
      sweeps.push_back(
          {tau, field->size, half == 0, directions, field->directions(), field->bytes[half].get()});
    }
    const int useful = OcclusionPipeline::most_workers(sweeps[0]) * static_cast<int>(sweeps.size());
    const int workers = std::min(executor.thread_count(), useful);
    OcclusionPipeline pipeline(sweeps, workers);
    executor.parallel_for(workers, [&](int worker, int) {
      if (!progress.cancelled()) pipeline.work(worker, [&] { return progress.advance(); });
    });
    return;
  }
  std::vector<float> open(field->voxels());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = static_cast<float>(tau[i]) / 255;
  for (int half = 0; half < 2; ++half) {
    if (halves >> half & 1) field->floats[half].reset(new float[samples]);
  }
  const int channels = static_cast<int>(field->channels()), n = field->directions();
  executor.parallel_for(2 * channels, [&](int i, int) {
    const int half = i / channels, channel = i % channels, quadrant = kQuadrantOfSlot[channel / n];
    if (!(halves >> half & 1) || progress.cancelled()) return;
    sweep_occlusion_f32(open.data(), field->size,
                        {(quadrant & 1) != 0, (quadrant & 2) != 0, half == 1},
                        directions[channel % n], field->floats[half].get() + channel, channels);
    progress.advance();
  });
}

Status check_sweep(const GridView<const float>& distance, const OcclusionSettings& settings) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  return validate_grid("distance", distance.data, distance.size, distance.spacing);
}

Status sweep_out_of_memory() {
  return {StatusCode::kOutOfMemory, "out of memory in the occlusion sweep; use a smaller volume"};
}
Status sweep_cancelled() {
  return {StatusCode::kCancelled, "the occlusion sweep was cancelled by the caller"};
}

}  // namespace obscura
