// Whichever allocation fails, a call says so by its Status and leaves its outputs as they were.
#include <gtest/gtest.h>

#include <functional>

#include "obscura/estimator.h"
#include "obscura/lighting.h"
#include "obscura/methods.h"
#include "obscura/terrain.h"
#include "obscura/volume.h"
#include "tests/allocation/failing_allocations.h"
#include "tests/property/synthetic.h"

namespace obscura {
namespace {

// The calling thread alone, so that allocations come in one order.
class Alone final : public Executor {
 public:
  int thread_count() const override { return 1; }
  void parallel_for(int count, FunctionRef<void(int, int)> body) override {
    for (int i = 0; i < count; ++i) body(i, 0);
  }
};

// Calls `call` with its first allocation failing, then its second, until it gets through; all of
// the first thousand, then every `stride`-th. `untouched` looks at the outputs of calls that
// failed.
void fail_each(const std::function<Status()>& call, const std::function<bool()>& untouched) {
  long failures = 0;
  for (long n = 0;; n += n < 1000 ? 1 : 97) {
    allocation::fail_at(n);
    const Status s = call();
    if (!allocation::stop_failing()) {
      EXPECT_TRUE(s.ok()) << s.message();
      break;
    }
    ++failures;
    ASSERT_EQ(s.code(), StatusCode::kOutOfMemory) << "allocation " << n << ": " << s.message();
    ASSERT_TRUE(untouched()) << "allocation " << n;
  }
  EXPECT_GT(failures, 3);
}

constexpr float kOld = -3;

bool all_old(const std::vector<float>& values) {
  return std::all_of(values.begin(), values.end(), [](float v) { return v == kOld; });
}

TEST(FailingAllocations, EveryMethod) {
  constexpr int kSide = 24;
  Random random(5);
  const synthetic::Input input =
      synthetic::blocks(kSide, kSide, synthetic::random_camera(kSide, kSide, false, &random), 9);
  const DepthField field = input.field();
  Alone alone;
  for (std::string_view method : method_names()) {
    for (const char* resolution : {"full", "half"}) {
      SCOPED_TRACE(testing::Message() << method << ", " << resolution);
      MethodSettings settings;
      ASSERT_TRUE(make_settings(method, &settings).ok());
      if (!set(&settings, "resolution", resolution).ok()) continue;
      std::vector<float> visible(kSide * kSide, kOld);
      const Outputs outputs{.visibility = {visible.data(), kSide, kSide}};
      fail_each([&] { return compute(field, settings, outputs, {.executor = &alone}); },
                [&] { return all_old(visible); });
    }
  }
}

TEST(FailingAllocations, Terrain) {
  constexpr int kSide = 60;
  std::vector<float> heights(kSide * kSide), svf(heights.size(), kOld), negative(svf);
  for (std::size_t i = 0; i < heights.size(); ++i) heights[i] = static_cast<float>(i * 7919 % 101);
  Alone alone;
  const RunOptions run{.executor = &alone};
  ElevationModel model;
  model.heights = {heights.data(), kSide, kSide};
  for (const double radius : {20.0, 40.0, 1e300}) {
    TerrainSettings settings;
    settings.azimuths = 8;
    settings.radius = radius;
    settings.curvature = true;
    TerrainOutputs outputs;
    outputs.svf = {svf.data(), kSide, kSide};
    outputs.negative_openness = {negative.data(), kSide, kSide};
    fail_each([&] { return compute_terrain(model, settings, outputs, run); },
              [&] { return all_old(svf) && all_old(negative); });
    std::fill(svf.begin(), svf.end(), kOld);
    std::fill(negative.begin(), negative.end(), kOld);
  }
}

TEST(FailingAllocations, Volumes) {
  constexpr int kSide = 20;
  std::vector<float> values, distance(kSide * kSide * kSide, kOld);
  for (int z = 0; z < kSide; ++z) {
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        values.push_back(static_cast<float>(6 - std::hypot(x - 9.5, y - 9.5, z - 9.5)));
      }
    }
  }
  Alone alone;
  const RunOptions run{.executor = &alone};
  VolumeView volume;
  volume.data = values.data();
  volume.type = VoxelType::kF32;
  volume.size = {kSide, kSide, kSide};
  DistanceSettings distances;
  distances.isovalue = 0;
  const GridView<float> out{distance.data(), {kSide, kSide, kSide}, {1, 1, 1}};
  fail_each([&] { return sweep_distance(volume, distances, out, run); },
            [&] { return all_old(distance); });
  const GridView<const float> in{distance.data(), {kSide, kSide, kSide}, {1, 1, 1}};
  for (const Transport transport :
       {Transport::kPaper, Transport::kFast, Transport::kBalanced, Transport::kAccurate}) {
    OcclusionSettings settings;
    settings.transport = transport;
    VisibilityField field;
    fail_each([&] { return sweep_occlusion(in, settings, &field, run); }, [&] { return true; });
    VisibilityField shadow;
    fail_each(
        [&] {
          return sweep_shadow(in, {1, 2, 3}, settings, &shadow, run);
        },
        [&] { return true; });
  }
}

}  // namespace
}  // namespace obscura
