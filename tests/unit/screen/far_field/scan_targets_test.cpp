// The scan's kernels are the same on every SIMD target.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "hwy/targets.h"
#include "screen/far_field/scan.h"
#include "tests/unit/screen/far_field/rough_field.h"

namespace obscura::far_field {
namespace {

TEST(Scan, EveryTargetFindsTheSame) {
  const auto executor = make_executor(1);
  const view::Geometry g = rough(97, 41, false, 33);
  FarFieldSettings settings{.occluder = Occluder::solid()};
  settings.directions = 5;
  const std::vector<Direction> directions = make_directions(settings);
  for (const Occluder& occluder : {Occluder{}, Occluder::of_thickness(0.3f)}) {
    std::vector<float> first;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
      hwy::SetSupportedTargetsForTest(target);
      std::vector<float> found;
      for (const Direction& d : directions) {
        Plane plane;
        fill_plane(g, occluder, d.transposed, sideways_reach(directions, settings.interval) + 32, 1,
                   *executor, &plane);
        ScanBuffer buffer;
        scan(plane, d, {settings.interval, -1}, *executor, &buffer);
        for (int level = 0; level < buffer.levels(); ++level) {
          for (int strip = 0; strip < buffer.strips(level); ++strip) {
            const RawStrip raw = buffer.raw(level, strip, 0);
            const auto& [begin, end] = raw.window;
            found.insert(found.end(), raw.nearest + begin, raw.nearest + end);
            found.insert(found.end(), raw.slanted + begin, raw.slanted + end);
          }
        }
      }
      if (first.empty()) first = found;
      for (std::size_t i = 0; i < found.size(); ++i) {
        if (std::isfinite(first[i])) {
          ASSERT_NEAR(found[i], first[i], 4e-6 * std::abs(first[i])) << hwy::TargetName(target);
        } else {
          ASSERT_EQ(found[i], first[i]) << hwy::TargetName(target);
        }
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

}  // namespace
}  // namespace obscura::far_field
