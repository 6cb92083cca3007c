#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "hwy/targets.h"
#include "obscura/volume.h"

namespace obscura {
namespace {

VolumeRange range_of(const VolumeView& v, int threads) {
  const auto executor = make_executor(threads);
  RunOptions run;
  run.executor = executor.get();
  VolumeRange range;
  const Status s = volume_range(v, &range, run);
  EXPECT_TRUE(s.ok()) << s.message();
  return range;
}

TEST(VolumeRange, IsThatOfPlainLoopsForAnyThreads) {
  for (const std::array<int, 3> n : {std::array{37, 5, 11}, {1, 1, 7}, {64, 3, 1}}) {
    std::vector<float> values(std::size_t(n[0]) * n[1] * n[2]);
    double sum = 0;
    float low = INFINITY, high = -INFINITY;
    std::int64_t finite = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      values[i] = i % 5 == 3   ? std::numeric_limits<float>::quiet_NaN()
                  : i % 7 == 2 ? std::copysign(INFINITY, i % 2 ? 1.0f : -1.0f)
                               : float(std::sin(0.7 * double(i)) * double(i));
      if (!std::isfinite(values[i])) continue;
      sum += values[i];
      low = std::min(low, values[i]);
      high = std::max(high, values[i]);
      ++finite;
    }
    VolumeView v;
    v.data = values.data();
    v.size = n;
    for (const std::uint32_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      const VolumeRange one = range_of(v, 1), many = range_of(v, 7);
      hwy::SetSupportedTargetsForTest(0);
      EXPECT_EQ(one.min, low);
      EXPECT_EQ(one.max, high);
      EXPECT_NEAR(one.mean, sum / double(finite), 1e-9 * double(values.size()));
      EXPECT_EQ(one.finite, finite);
      EXPECT_EQ(one.not_finite, std::int64_t(values.size()) - finite);
      EXPECT_EQ(one.mean, many.mean);
      EXPECT_EQ(one.finite, many.finite);
    }
  }
}

TEST(VolumeRange, ReadsTypesScalesAndStrides) {
  const std::int16_t samples[] = {5, -7, 9, 100, 2, 3};
  VolumeView v;
  v.data = samples;
  v.type = VoxelType::kI16;
  v.size = {2, 1, 1};
  v.stride = {2, 6, 6};
  v.slope = -2;
  v.intercept = 1;
  const VolumeRange range = range_of(v, 1);
  EXPECT_EQ(range.min, -17);
  EXPECT_EQ(range.max, -9);
  EXPECT_EQ(range.mean, -13);
}

TEST(VolumeRange, NothingFiniteIsAMistake) {
  const float nothing[] = {NAN, INFINITY};
  VolumeView v;
  v.data = nothing;
  v.size = {2, 1, 1};
  VolumeRange range;
  EXPECT_NE(volume_range(v, &range).message().find("no finite voxel"), std::string::npos);
}

}  // namespace
}  // namespace obscura
