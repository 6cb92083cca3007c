// The distance sweep on any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "obscura/volume.h"
#include "tests/reference/plain_threads.h"
#include "tests/reference/volume_sweeps.h"
#include "volume/distance_kernel.h"

namespace obscura {
namespace {

using reference::Grid;

Grid blobs(std::array<int, 3> n, std::array<float, 3> h) {
  Grid f(n, h);
  f.fill([](double x, double y, double z) {
    const double low = std::hypot(x - 9.3, y - 18.1, z - 6.7) - 4.4;
    const double high = std::hypot(x - 15.2, y - 120.4, z - 3.9) - 5.7;
    return std::min(low, high);
  });
  return f;
}

Status sweep(const Grid& f, const RunOptions& run, std::vector<float>* distance) {
  VolumeView view;
  view.data = f.v.data();
  view.size = f.size;
  view.spacing = f.spacing;
  distance->assign(f.v.size(), -1.0f);
  DistanceSettings settings;
  settings.solid = SolidSide::kBelow;
  settings.sweeps = 16;
  return sweep_distance(view, settings, {distance->data(), f.size, f.spacing}, run);
}

std::vector<float> by_one_thread(const Grid& f) {
  std::vector<float> distance;
  EXPECT_TRUE(sweep(f, {.threads = 1}, &distance).ok());
  return distance;
}

// Several groups of strips, one that is not full, one plane, one row; more threads than processors
// and than groups.
TEST(DistanceThreads, BitsDoNotDependOnThreads) {
  for (const std::array<int, 3>& n :
       {std::array{40, 200, 14}, {61, 43, 37}, {33, 150, 1}, {25, 1, 12}, {1, 130, 9}}) {
    const Grid f = blobs(n, {1, n[0] == 61 ? 1.2f : 1.0f, 1});
    if (!(*std::min_element(f.v.begin(), f.v.end()) < 0)) continue;  // nothing to cut
    const std::vector<float> one = by_one_thread(f);
    for (const int threads : {2, 3, 8, 64}) {
      reference::PlainThreads executor(threads);
      RunOptions run;
      run.executor = &executor;
      std::vector<float> many;
      ASSERT_TRUE(sweep(f, run, &many).ok());
      ASSERT_EQ(one, many) << threads << " threads, " << n[0] << "x" << n[1] << "x" << n[2];
    }
  }
}

// Runs its loops' bodies one after another, the last first, as an executor may.
class LastFirst final : public Executor {
 public:
  int thread_count() const override { return 4; }
  void parallel_for(int count, FunctionRef<void(int, int)> body) override {
    for (int i = count - 1; i >= 0; --i) body(i, i % 4);
  }
};

TEST(DistanceThreads, NoWorkerWaitsForOneThatHasNotBegun) {
  const Grid f = blobs({40, 200, 14}, {1, 1, 1});
  LastFirst executor;
  RunOptions run;
  run.executor = &executor;
  std::vector<float> distance;
  ASSERT_TRUE(sweep(f, run, &distance).ok());
  EXPECT_EQ(distance, by_one_thread(f));
}

TEST(DistanceThreads, CancelsOnManyThreads) {
  const Grid f = blobs({40, 200, 40}, {1, 1, 1});
  reference::PlainThreads executor(8);
  RunOptions run;
  run.executor = &executor;
  run.progress = [](double share) { return share < 0.3; };
  std::vector<float> distance;
  EXPECT_EQ(sweep(f, run, &distance).code(), StatusCode::kCancelled);
}

// The longest chain of 512^3: two stages, and groups of strips within a plane.
TEST(DistanceThreads, WorkIsSeveralTimesTheSpan) {
  const float spacing[3] = {1, 1, 1};
  const DistanceStage stage(512, 512, spacing, false);
  const DistanceStage::Count count = stage.count(512);
  EXPECT_GT(count.work, 5 * count.span);
}

}  // namespace
}  // namespace obscura
