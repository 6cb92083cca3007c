#include "volume/distance_pass.h"

#include <atomic>

namespace obscura {

bool sweep_distance_pass(GridView<float> distance, bool rising, DistanceStage& first,
                         DistanceStage& second, Executor& executor, int workers,
                         Progress& progress) {
  const auto stride = distance.strides();
  const int depth = distance.size[2], groups = first.groups();
  auto plane = [&](int k) {
    const int z = rising ? k : depth - 1 - k;
    return DistanceStage::Plane{distance.data + z * stride[2], stride[0], stride[1]};
  };
  if (workers == 1) {
    for (int k = 0; k <= depth; ++k) {
      if (k > 0) second.sweep(plane(k - 1).data, stride[0], stride[1]);
      if (k < depth) first.sweep(plane(k).data, stride[0], stride[1]);
      if (!progress.advance()) return false;
    }
    return true;
  }
  const std::int64_t parts = std::int64_t{4} * groups, all = parts * (depth + 1);
  std::atomic<std::int64_t> next{0};
  executor.parallel_for(workers, [&](int worker, int) {
    while (!progress.cancelled()) {
      const std::int64_t taken = next++;
      if (taken >= all) return;
      const int part = static_cast<int>(taken % parts), at = part / 2;
      const bool ahead = part % 2 == 0, forward = at < groups;
      const int k = static_cast<int>(taken / parts) - (ahead ? 0 : 1);
      const int group = forward ? at : 2 * groups - 1 - at;
      if (k >= 0 && k < depth) {
        if (!ahead && forward) second.follow(first, k, group);
        (ahead ? first : second).sweep_group(plane(k), k, forward, group, worker);
      }
      if (part == parts - 1) progress.advance();
    }
  });
  return !progress.cancelled();
}

}  // namespace obscura
