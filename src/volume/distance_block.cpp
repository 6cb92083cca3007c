// Blocks of the distance sweep.
#include <algorithm>

#include "core/guarded.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "obscura/volume_blocks.h"
#include "volume/distance_pass.h"
#include "volume/distance_start.h"
#include "volume/volume_access.h"

namespace obscura {

Status check_isovalue(const VolumeRange& range, const DistanceSettings& settings) {
  // A value equal to the isovalue is solid.
  const bool cuts = settings.solid == SolidSide::kAbove
                        ? range.min < settings.isovalue && settings.isovalue <= range.max
                        : range.min <= settings.isovalue && settings.isovalue < range.max;
  if (cuts) return {};
  return invalid_argument(text("isovalue is ", settings.isovalue,
                               ", which does not cut the volume; its values go from ", range.min,
                               " to ", range.max));
}

Status start_distance_block(const VolumeView& samples, bool below, bool above,
                            const DistanceSettings& settings, GridView<float> distance,
                            const RunOptions& run) {
  return guarded("the start of a block's distances; use smaller blocks", [&]() -> Status {
    if (Status s = validate_ranges(settings); !s.ok()) return s;
    if (Status s = validate(samples); !s.ok()) return s;
    if (Status s = validate_grid("distance", distance.data, distance.size, samples.spacing);
        !s.ok()) {
      return s;
    }
    const int more = int{below} + int{above};
    if (distance.size[0] != samples.size[0] || distance.size[1] != samples.size[1] ||
        distance.size[2] + more != samples.size[2]) {
      return invalid_input(text("samples.size is ", samples.size[0], "x", samples.size[1], "x",
                                samples.size[2], "; it must be distance's, ", distance.size[0], "x",
                                distance.size[1], "x", distance.size[2], ", with ", more,
                                " more along z"));
    }
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    start_distance(samples, int{below}, settings, distance, threads.executor());
    return {};
  });
}

Status sweep_distance_block(GridView<float> distance, bool rising, std::span<const float> upwind,
                            std::span<float> downwind, bool* changed, const RunOptions& run) {
  return guarded("a block of the distance sweep; use smaller blocks", [&]() -> Status {
    if (Status s = validate_grid("distance", distance.data, distance.size, distance.spacing);
        !s.ok()) {
      return s;
    }
    const std::size_t size = distance_face_size(distance.size[0], distance.size[1]);
    for (const auto& [name, given] :
         {std::pair{"upwind", upwind.size()}, {"downwind", downwind.size()}}) {
      if (given != 0 && given != size) {
        return invalid_input(text(name, " holds ", given, " floats; it must be empty or hold ",
                                  size, ", two planes"));
      }
    }
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    const int workers =
        std::min(executor.thread_count(), 2 * DistanceStage::groups_of(distance.size[1]));
    const float* spacing = distance.spacing.data();
    DistanceStage first(distance.size[0], distance.size[1], spacing, false, workers);
    DistanceStage second(distance.size[0], distance.size[1], spacing, true, workers);
    first.begin_pass(upwind.empty() ? nullptr : upwind.data());
    second.begin_pass(upwind.empty() ? nullptr : upwind.data() + size / 2);
    Progress progress(distance.size[2] + 1, run.progress);
    if (!sweep_distance_pass(distance, rising, first, second, executor, workers, progress)) {
      return {StatusCode::kCancelled, "the distance sweep was cancelled by the caller"};
    }
    if (!downwind.empty()) {
      first.end_pass(distance.size[2], downwind.data());
      second.end_pass(distance.size[2], downwind.data() + size / 2);
    }
    if (changed) *changed = int{first.take_changed()} + int{second.take_changed()} > 0;
    return {};
  });
}

}  // namespace obscura
