#include <memory>
#include <new>

#include "core/progress.h"
#include "core/run_threads.h"
#include "volume/sweep_halves.h"
#include "volume/transport.h"
#include "volume/visibility_field.h"

namespace obscura {
namespace {

Status sweep(GridView<const float> distance, const OcclusionSettings& settings,
             VisibilityField* field, const RunOptions& run) {
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  VisibilityField result;
  VisibilityFieldImpl& f = result.impl();
  set_occlusion_grid(distance, settings, &f);
  if (f.scheme.plane && !f.take_plane(field->impl())) {
    f.plane = std::make_shared<PlaneTable>(f.scheme, f.spacing, occlusion_unit(f), settings.alpha,
                                           executor);
  }

  const std::unique_ptr<std::uint8_t[]> tau(new std::uint8_t[f.voxels()]);
  occlusion_tau(distance, f, executor, tau.get());
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
