// A background that nobody declared is a surface far behind all others. How far must not matter to
// those: a sky at 100 is as good as one at 3e38.
#include "tests/property/backdrop.h"

#include <gtest/gtest.h>

#include "obscura/obscura.h"

namespace obscura {
namespace {

using namespace synthetic;

std::vector<float> visibility(const Input& in, const MethodSettings& settings) {
  std::vector<float> v(in.depth.size());
  const Status s = compute(in.field(), settings, {.visibility = {v.data(), in.width, in.height}});
  EXPECT_TRUE(s.ok()) << s.message();
  return v;
}

TEST(Backdrop, MovesNothingBeforeItByAnyMethod) {
  for (const MethodSettings& settings : default_methods()) {
    for_each_backdrop({34, 100, 1e4, 1e6, 1.9e8}, [&](const std::string& what, const Input& in,
                                                      const Input& open) {
      EXPECT_LE(moved(open, visibility(in, settings), visibility(open, settings)), kUnmoved)
          << method_name(settings) << ", " << what;
    });
  }
}

// Every falloff but the inverse square, which still counts 1 % at ten times its length; and a
// length as long as the scene is deep.
TEST(Backdrop, MovesNothingWithOtherFalloffs) {
  for (const char* name : {"far-field", "horizon", "mipmap", "ray-traced"}) {
    for (const char* falloff : {"constant", "exponential", "quadratic"}) {
      MethodSettings settings;
      ASSERT_TRUE(make_settings(name, &settings).ok());
      ASSERT_TRUE(set(&settings, "falloff", falloff).ok());
      ASSERT_TRUE(set(&settings, "radius", "3").ok());
      if (std::string(name) == "ray-traced") {
        ASSERT_TRUE(set(&settings, "rays", "16").ok());
      }
      for (const bool orthographic : {false, true}) {
        const Input open = before_backdrop(orthographic, Backdrop::kNone, 0);
        const Input in = before_backdrop(orthographic, Backdrop::kNoisy, 1e5);
        EXPECT_LE(moved(open, visibility(in, settings), visibility(open, settings)), kUnmoved)
            << name << ", " << falloff << ", orthographic " << orthographic;
      }
    }
  }
}

// Against the geometry itself: what is far behind is still a surface, which near ones obscure.
TEST(Backdrop, IsAReceiver) {
  Input in = before_backdrop(false, Backdrop::kFlat, 34);
  LineSettings line;
  line.falloff.radius = 20;
  line.blur = false;
  const std::vector<float> v = visibility(in, line);
  double least = 1;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (in.depth[i] > 30) least = std::min<double>(least, v[i]);
  }
  EXPECT_LT(least, 0.9);
}

// The room behind a hand before the lens keeps its corners.
TEST(Backdrop, RoomBehindAHandKeepsItsCorners) {
  const int w = 96, h = 64;
  Input room{w, h, {}, {}, Camera::perspective(0.9f, w, h), {}};
  for (int y = 0; y < h; ++y) {
    // Floor 1.2 below and wall 5 ahead.
    const double b = (h / 2 - y - 0.5) * room.camera.scale_y;
    const double z = b < 0 ? std::min(5.0, -1.2 / b) : 5.0;
    for (int x = 0; x < w; ++x) room.depth.push_back(static_cast<float>(z));
  }
  Input hand = room;
  for (int y = 40; y < h; ++y) {
    for (int x = 0; x < 20; ++x) hand.depth[static_cast<std::size_t>(y) * w + x] = 0.3f;
  }
  for (const MethodSettings& settings : default_methods()) {
    const std::vector<float> a = visibility(room, settings), b = visibility(hand, settings);
    double difference = 0;
    for (int y = 0; y < h; ++y) {
      for (int x = 60; x < w; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * w + x;
        difference = std::max(difference, std::abs(double{a[i]} - b[i]));
      }
    }
    EXPECT_LT(difference, 0.1) << method_name(settings);
  }
}

}  // namespace
}  // namespace obscura
