// The occlusion sweep on any number of threads.
#include <gtest/gtest.h>

#include <cmath>

#include "obscura/volume.h"
#include "tests/reference/plain_threads.h"
#include "tests/reference/volume_sweeps.h"
#include "volume/occlusion_kernel.h"
#include "volume/transport.h"

namespace obscura {
namespace {

using reference::Grid;

GridView<const float> view_of(const Grid& g) { return {g.v.data(), g.size, g.spacing}; }
GridView<float> out_of(Grid& g) { return {g.v.data(), g.size, g.spacing}; }

Grid blobs(std::array<int, 3> n) {
  Grid d(n, {1, 1, 1});
  d.fill([](double x, double y, double z) {
    return std::min(std::hypot(x - 9.3, y - 8.1, z - 6.7) - 4.4, z - 2.3 + 0.1 * x);
  });
  return d;
}

// By one thread.
VisibilityField field_of(const Grid& d, Transport transport = Transport::kBalanced) {
  VisibilityField field;
  const Status s = sweep_occlusion(view_of(d), {.transport = transport}, &field, {.threads = 1});
  EXPECT_TRUE(s.ok()) << s.message();
  return field;
}

// Also with more threads than processors, strips or planes.
TEST(OcclusionThreads, BitsDoNotDependOnThreads) {
  for (const std::array<int, 3>& n :
       {std::array{45, 31, 26}, {20, 150, 70}, {33, 34, 1}, {5, 1, 40}}) {
    const Grid d = blobs(n);
    for (Transport t :
         {Transport::kPaper, Transport::kFast, Transport::kBalanced, Transport::kAccurate}) {
      const VisibilityField one = field_of(d, t);
      for (const int threads : {3, 8, 64}) {
        reference::PlainThreads executor(threads);
        RunOptions run;
        run.executor = &executor;
        VisibilityField many;
        ASSERT_TRUE(sweep_occlusion(view_of(d), {.transport = t}, &many, run).ok());
        Grid a(one.size()), b(one.size());
        for (int s = 0; s < 8; ++s) {
          ASSERT_TRUE(one.octant(s, out_of(a)).ok());
          ASSERT_TRUE(many.octant(s, out_of(b)).ok());
          ASSERT_EQ(a.v, b.v) << enum_name(t) << " with " << threads << " threads";
        }
      }
    }
    // Shadows: one half of the octants.
    VisibilityField one, many;
    ASSERT_TRUE(sweep_shadow(view_of(d), {1, 2, 3}, {}, &one, {.threads = 1}).ok());
    reference::PlainThreads executor(8);
    RunOptions run;
    run.executor = &executor;
    ASSERT_TRUE(sweep_shadow(view_of(d), {1, 2, 3}, {}, &many, run).ok());
    Grid a(one.size()), b(one.size());
    ASSERT_TRUE(one.octant(7, out_of(a)).ok());
    ASSERT_TRUE(many.octant(7, out_of(b)).ok());
    ASSERT_EQ(a.v, b.v);
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

TEST(OcclusionThreads, NoWorkerWaitsForOneThatHasNotBegun) {
  const Grid d = blobs({45, 70, 26});
  LastFirst executor;
  RunOptions run;
  run.executor = &executor;
  VisibilityField field;
  ASSERT_TRUE(sweep_occlusion(view_of(d), {}, &field, run).ok());
  Grid a(field.size()), b(field.size());
  ASSERT_TRUE(field.octant(3, out_of(a)).ok());
  ASSERT_TRUE(field_of(d).octant(3, out_of(b)).ok());
  EXPECT_EQ(a.v, b.v);
}

// Cancelled by the first call of its progress, a sweep of many threads comes back.
TEST(OcclusionThreads, CancelsOnManyThreads) {
  const Grid d = blobs({45, 70, 60});
  reference::PlainThreads executor(8);
  RunOptions run;
  run.executor = &executor;
  run.progress = [](double) { return false; };
  VisibilityField field;
  EXPECT_EQ(sweep_occlusion(view_of(d), {}, &field, run).code(), StatusCode::kCancelled);
}

// 512^3 voxels at half resolution: the longest chain of strips is at most a sixteenth of all work.
TEST(OcclusionThreads, WorkIsAtLeastSixteenTimesTheSpan) {
  for (const Transport t : {Transport::kBalanced, Transport::kAccurate}) {
    const TransportScheme scheme = transport_scheme(t, {1, 1, 1});
    std::vector<OcclusionSweep> halves(2);
    for (OcclusionSweep& half : halves) {
      half.size = {256, 256, 256};
      half.directions = scheme.directions.data();
      half.count = static_cast<int>(scheme.directions.size());
    }
    const OcclusionPipeline::Count count = OcclusionPipeline(halves, 1).count();
    EXPECT_GE(count.work, 16 * count.span) << enum_name(t);
  }
}

}  // namespace
}  // namespace obscura
