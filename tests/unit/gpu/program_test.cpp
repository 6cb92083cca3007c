#include "gpu/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "screen/gpu.h"
#include "shaders/line.h"

namespace obscura::gpu {
namespace {

template <class Settings>
void add_variants(std::vector<MethodSettings>* all, Settings s) {
  for (Resolution resolution : {Resolution::kFull, Resolution::kHalf}) {
    s.resolution = resolution;
    all->emplace_back(s);
  }
}

std::vector<MethodSettings> methods() {
  std::vector<MethodSettings> all;
  LineSettings line;
  line.dual.second_radius = 2.0f;
  line.occluder = {.kind = OccluderKind::kThickness, .thickness = 1};
  add_variants(&all, LineSettings{});
  add_variants(&all, line);
  line.blur = false;
  add_variants(&all, line);
  add_variants(&all, AreaSettings{});
  PointSettings point;
  add_variants(&all, point);
  point.pattern = PointPattern::kScreen;
  add_variants(&all, point);
  point.dual.second_radius = 2.0f;
  add_variants(&all, point);
  add_variants(&all, HemisphereSettings{});
  add_variants(&all, HorizonSettings{});
  add_variants(&all, MipmapSettings{});
  FarFieldSettings far;
  for (OccluderKind kind : {OccluderKind::kSolid, OccluderKind::kThickness,
                            OccluderKind::kBackDepth, OccluderKind::kAuto}) {
    for (FarFieldPreset preset : {FarFieldPreset::kFast, FarFieldPreset::kHigh}) {
      far.occluder = {.kind = kind, .thickness = kind == OccluderKind::kThickness ? 1.0f : 0.0f};
      far.preset = preset;
      add_variants(&all, far);
    }
  }
  return all;
}

bool writes(const Program& program, Slot::Kind image) {
  return std::ranges::any_of(program.passes, [&](const Pass& pass) {
    return std::ranges::any_of(pass.slots, [&](const BoundSlot& b) { return b.slot == image; });
  });
}

TEST(GpuProgram, EveryPassGivesItsShaderAllThatItNeeds) {
  for (const MethodSettings& method : methods()) {
    for (Directions directions : {Directions::kNone, Directions::kSigned, Directions::kUnsigned}) {
      FrameShape shape{.width = 70, .height = 50, .guard_band = {3, 2, 1, 4}};
      shape.back_depth = true;
      shape.directions = directions;
      Program program;
      const Status made = make_program(method, shape, &program);
      EXPECT_TRUE(made.ok() || directions != Directions::kNone) << made.message();
      if (!made.ok()) continue;
      for (const Pass& pass : program.passes) {
        const Status status = check(pass);
        EXPECT_TRUE(status.ok()) << status.message();
      }
      EXPECT_TRUE(writes(program, Slot::kVisibilityImage));
      EXPECT_EQ(writes(program, Slot::kBentNormalImage), directions != Directions::kNone);
      EXPECT_FALSE(program.half);
    }
  }
}

Pass line_pass() {
  Program program;
  const FrameShape shape{.width = 16, .height = 16};
  EXPECT_TRUE(make_program(LineSettings{}, shape, &program).ok());
  return *std::ranges::find(program.passes, std::string("line"), &Pass::name);
}

TEST(GpuProgram, AnIncompletePassIsFound) {
  ASSERT_TRUE(check(line_pass()).ok());
  Pass pass = line_pass();
  pass.constants.pop_back();
  EXPECT_EQ(check(pass).code(), StatusCode::kInternal);
  pass = line_pass();
  pass.constants.push_back(pass.constants.front());
  EXPECT_FALSE(check(pass).ok());
  pass = line_pass();
  pass.slots.pop_back();
  EXPECT_FALSE(check(pass).ok());
  pass = line_pass();
  pass.slots.back().slot =
      Slot::kDepthImage == pass.slots.back().slot.kind ? Slot(0) : Slot::kDepthImage;
  EXPECT_FALSE(check(pass).ok());
  pass = line_pass();
  pass.push.push_back(0);
  EXPECT_FALSE(check(pass).ok());
}

// At half resolution a method's own passes leave the frame's images alone; the last one fills them.
TEST(GpuProgram, HalfResolutionGoesThroughScratchMemory) {
  Program program;
  HorizonSettings settings;
  settings.resolution = Resolution::kHalf;
  const FrameShape shape{.width = 64, .height = 48, .directions = Directions::kUnsigned};
  ASSERT_TRUE(make_program(settings, shape, &program).ok());
  for (const Pass& pass : program.passes) {
    const bool last = &pass == &program.passes.back();
    EXPECT_EQ(std::ranges::any_of(pass.slots, [](const auto& b) { return b.slot.is_result(); }),
              last);
  }
  EXPECT_TRUE(std::ranges::any_of(program.passes, &Pass::to_scratch));
  EXPECT_FALSE(program.passes.back().half);
}

TEST(GpuProgram, MethodsRefuseWhatTheyDoNotGive) {
  Program program;
  FrameShape shape{.width = 16, .height = 16, .directions = Directions::kSigned};
  EXPECT_EQ(make_program(LineSettings{}, shape, &program).message(), "line gives no directions");
  shape.normal_use = NormalUse::kNone;
  EXPECT_EQ(make_program(HorizonSettings{}, shape, &program).message(),
            "horizon needs normals; normal_use is none");
  EXPECT_EQ(make_program(ReferenceSettings{}, shape, &program).code(), StatusCode::kUnsupported);
}

}  // namespace
}  // namespace obscura::gpu
