#include <algorithm>
#include <cmath>
#include <memory>
#include <new>

#include "core/progress.h"
#include "core/run_threads.h"
#include "volume/sweep_halves.h"
#include "volume/transport.h"
#include "volume/visibility_field.h"

namespace obscura {
namespace {

float unit_of(const Vec3& spacing) {
  return std::cbrt(spacing[0]) * std::cbrt(spacing[1]) * std::cbrt(spacing[2]);
}

Status sweep(GridView<const float> distance, const OcclusionSettings& settings,
             VisibilityField* field, const RunOptions& run) {
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  VisibilityField result;
  VisibilityFieldImpl& f = result.impl();
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
  const float unit = unit_of(f.spacing);
  if (f.scheme.plane && !f.take_plane(field->impl())) {
    f.plane = std::make_shared<PlaneTable>(f.scheme, f.spacing, unit, settings.alpha, executor);
  }

  // Transmittance of a cell from the mean of its voxels' distances.
  const std::unique_ptr<std::uint8_t[]> tau(new std::uint8_t[f.voxels()]);
  const auto stride = distance.strides();
  const float scale = 1 / (unit * static_cast<float>(cell * cell * cell));
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
      transmittance_row(rows, count, stride[0], distance.size[0], cell, scale, settings.alpha,
                        tau.get() + static_cast<std::size_t>(f.size[0]) *
                                        (y + static_cast<std::size_t>(f.size[1]) * z));
    }
  });
  Progress progress(settings.precision == VisibilityPrecision::kU8
                        ? std::int64_t{2} * f.size[2]
                        : static_cast<std::int64_t>(2 * f.channels()),
                    run.progress);
  if (settings.precision == VisibilityPrecision::kU8) f.take_bytes(&field->impl());
  sweep_halves(tau.get(), settings, 3, executor, progress, &f);
  if (progress.cancelled()) return sweep_cancelled();
  *field = std::move(result);
  return {};
}

}  // namespace

Status sweep_occlusion(GridView<const float> distance, const OcclusionSettings& settings,
                       VisibilityField* field, const RunOptions& run) {
  if (Status s = check_sweep(distance, settings); !s.ok()) return s;
  try {
    return sweep(distance, settings, field, run);
  } catch (const std::bad_alloc&) {
    return sweep_out_of_memory();
  }
}

}  // namespace obscura
