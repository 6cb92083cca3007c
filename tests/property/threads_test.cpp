#include <gtest/gtest.h>

#include "obscura/estimator.h"
#include "obscura/methods.h"
#include "tests/property/synthetic.h"
#include "tests/reference/every_output.h"
#include "tests/reference/plain_threads.h"

namespace obscura {
namespace {

constexpr int kWidth = 61, kHeight = 37;

synthetic::Input scene() {
  Random random(5);
  synthetic::Input input = synthetic::blocks(
      kWidth, kHeight, synthetic::random_camera(kWidth, kHeight, false, &random), 9);
  input.guard_band = {6, 5, 4, 3};
  return input;
}

// A method's settings in every form of work that its tables know: shared, blurred, half resolution.
std::vector<MethodSettings> variants(std::string_view method) {
  MethodSettings defaults;
  EXPECT_TRUE(make_settings(method, &defaults).ok());
  std::vector<MethodSettings> all = {defaults};
  const std::pair<const char*, const char*> changes[] = {
      {"resolution", "half"},        {"separable", "3"},     {"jitter", "true"},
      {"occluder", "thickness:0.3"}, {"variant", "classic"}, {"pattern", "screen"},
      {"second_radius", "0.4"},      {"blur", "false"}};
  for (const auto& [field, text] : changes) {
    MethodSettings changed = defaults;
    if (field == std::string_view("separable")) (void)set(&changed, "directions", "9");
    if (set(&changed, field, text).ok()) all.push_back(changed);
  }
  return all;
}

// The same bits for any number of threads, also with many more of them than processors.
TEST(Threads, EveryMethodAndOutputHasTheSameBits) {
  const synthetic::Input input = scene();
  const DepthField field = input.field();
  for (std::string_view method : method_names()) {
    for (const MethodSettings& settings : variants(method)) {
      const std::vector<bool> offered = reference::EveryOutput::offered(settings, field);
      reference::EveryOutput expected(field.visible(), -3);
      const Status first = compute(field, settings, expected.outputs(offered), {.threads = 1});
      ASSERT_TRUE(first.ok()) << method << ": " << first.message();
      for (int threads : {2, 3, 8, 64}) {
        SCOPED_TRACE(testing::Message() << method << ", " << threads << " threads");
        reference::PlainThreads executor(threads);
        reference::EveryOutput found(field.visible(), -3);
        ASSERT_TRUE(compute(field, settings, found.outputs(offered), {.executor = &executor}).ok());
        EXPECT_EQ(found.values(), expected.values());
      }
    }
  }
}

// One object cannot run twice at once: the second call says so and does nothing.
TEST(Threads, AnEstimatorThatIsRunningRefusesToRun) {
  const synthetic::Input input = scene();
  const DepthField field = input.field();
  const Extent size = field.visible();
  std::vector<float> visible(static_cast<std::size_t>(size.width) * size.height);
  std::vector<float> other(visible.size(), -3);
  Estimator estimator;
  ASSERT_TRUE(Estimator::create(LineSettings{}, kWidth, kHeight, &estimator).ok());
  int calls = 0;
  const RunOptions options{.threads = 1, .progress = [&](double) {
                             const Status s = estimator.run(
                                 field, {.visibility = {other.data(), size.width, size.height}});
                             EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
                             EXPECT_NE(s.message().find("running already"), std::string::npos);
                             ++calls;
                             return true;
                           }};
  const Outputs outputs{.visibility = {visible.data(), size.width, size.height}};
  ASSERT_TRUE(estimator.run(field, outputs, options).ok());
  EXPECT_GT(calls, 0);
  EXPECT_EQ(other, std::vector<float>(visible.size(), -3));
  EXPECT_TRUE(estimator.run(field, outputs).ok());
}

TEST(Threads, WhatDoesNotExistIsRefused) {
  EXPECT_EQ(Estimator::create(LineSettings{}, 8, 8, nullptr).code(), StatusCode::kInvalidArgument);
  Estimator estimator;
  FarFieldSettings settings{.occluder = Occluder::solid()};
  settings.profile = static_cast<SlabProfile>(7);
  const Status s = Estimator::create(settings, 8, 8, &estimator);
  EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(s.message(), "profile is 7; it must be one of slab, adaptive-chord");
  synthetic::Input input = scene();
  DepthField field = input.field();
  field.depth_kind = static_cast<DepthKind>(-2);
  const Extent size = field.visible();
  std::vector<float> visible(static_cast<std::size_t>(size.width) * size.height, -3);
  const Outputs outputs{.visibility = {visible.data(), size.width, size.height}};
  EXPECT_EQ(compute(field, LineSettings{}, outputs).code(), StatusCode::kInvalidArgument);
  field = input.field();
  field.normal_use = static_cast<NormalUse>(9);
  EXPECT_EQ(compute(field, LineSettings{}, outputs).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(visible, std::vector<float>(visible.size(), -3));
}

}  // namespace
}  // namespace obscura
