#include <algorithm>
#include <limits>
#include <new>

#include "core/guarded.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "obscura/volume_blocks.h"
#include "volume/distance_pass.h"
#include "volume/distance_start.h"
#include "volume/volume_access.h"

namespace obscura {
namespace {

constexpr int kMaxSweeps = 800;

Status sweep(const VolumeView& volume, const DistanceSettings& settings, GridView<float> distance,
             Executor& executor, const RunOptions& run, DistanceReport* report) {
  // Of both stages, each group by a thread of its own; more threads would only wait.
  const int workers =
      std::min(executor.thread_count(), 2 * DistanceStage::groups_of(volume.size[1]));
  DistanceStage first(volume.size[0], volume.size[1], volume.spacing.data(), false, workers);
  DistanceStage second(volume.size[0], volume.size[1], volume.spacing.data(), true, workers);

  start_distance(volume, 0, settings, distance, executor);
  const int rounds = (settings.sweeps + 7) / 8;
  const int most = settings.converge ? kMaxSweeps / 8 : rounds;
  Progress progress(static_cast<std::int64_t>(rounds) * 2 * (volume.size[2] + 1), run.progress);
  DistanceReport done;
  for (int round = 0; round < most && !done.converged; ++round) {
    for (const bool rising : {true, false}) {
      first.begin_pass();
      second.begin_pass();
      if (!sweep_distance_pass(distance, rising, first, second, executor, workers, progress)) {
        return {StatusCode::kCancelled, "the distance sweep was cancelled by the caller"};
      }
    }
    done.sweeps += 8;
    const bool changed = int{first.take_changed()} + int{second.take_changed()} > 0;
    done.converged = settings.converge && round + 1 >= rounds && !changed;
  }
  if (report) *report = done;
  return {};
}

}  // namespace

Status sweep_distance(const VolumeView& volume, const DistanceSettings& settings,
                      GridView<float> distance, const RunOptions& run, DistanceReport* report) {
  return guarded("the distance sweep; use a smaller volume", [&]() -> Status {
    if (Status s = validate_ranges(settings); !s.ok()) return s;
    if (Status s = validate(volume); !s.ok()) return s;
    if (Status s = validate_grid("distance", distance.data, distance.size, volume.spacing);
        !s.ok()) {
      return s;
    }
    if (distance.size != volume.size) {
      return invalid_input(text("distance.size is ", distance.size[0], "x", distance.size[1], "x",
                                distance.size[2], "; it must be the volume's, ", volume.size[0],
                                "x", volume.size[1], "x", volume.size[2]));
    }
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    VolumeRange range;
    RunOptions unseen;  // the range is quick and reports no progress
    unseen.executor = &executor;
    if (Status s = volume_range(volume, &range, unseen); !s.ok()) return s;
    if (Status s = check_isovalue(range, settings); !s.ok()) return s;
    return sweep(volume, settings, distance, executor, run, report);
  });
}

}  // namespace obscura
