#include "obscura/settings.h"

#include <gtest/gtest.h>

#include <string>

#include "obscura/line.h"

namespace obscura {
namespace {

constexpr Field kRadius{"radius", "world units", positive(), ""};
constexpr Field kCount{"count", "", closed(1, 32), ""};

template <class T>
Status parse(const Field& field, const char* text, T* value) {
  return parse_setting(std::string("--") + field.name, field, text, value);
}

TEST(Settings, NumbersInRangeAreRead) {
  float f = 0;
  int i = 0;
  EXPECT_TRUE(parse(kRadius, "0.25", &f).ok());
  EXPECT_EQ(f, 0.25f);
  EXPECT_TRUE(parse(kRadius, "1e-3", &f).ok());
  EXPECT_TRUE(parse(kCount, "32", &i).ok());
  EXPECT_EQ(i, 32);
}

TEST(Settings, OthersAreRefusedAndLeaveTheValueAlone) {
  float f = 7;
  for (const char* bad : {"", "x", "1x", " 1", "0", "-1", "nan", "inf", "1e-60", "1e60"}) {
    EXPECT_FALSE(parse(kRadius, bad, &f).ok()) << bad;
  }
  EXPECT_EQ(f, 7);
  int i = 7;
  for (const char* bad : {"0", "33", "2.5", "99999999999999999999"}) {
    EXPECT_FALSE(parse(kCount, bad, &i).ok()) << bad;
  }
  EXPECT_EQ(i, 7);
}

TEST(Settings, MessagesNameTheOptionAndTheRange) {
  float f;
  EXPECT_EQ(parse(kRadius, "-1", &f).message(),
            "--radius is '-1'; it must be a number in (0, inf)");
  FalloffKind kind;
  EXPECT_EQ(parse({"falloff", "", {}, ""}, "linear", &kind).message(),
            "--falloff is 'linear'; it must be one of constant, exponential, quadratic, "
            "inverse-square");
}

TEST(Settings, OccludersReadBack) {
  for (const char* text : {"solid", "thickness:0.5", "back-depth", "layers:8"}) {
    Occluder o;
    ASSERT_TRUE(SettingText<Occluder>::parse(text, &o)) << text;
    EXPECT_EQ(write_setting(o), text);
  }
  Occluder o;
  for (const char* bad : {"", "thick", "thickness", "thickness:", "thickness:0", "thickness:-1",
                          "thickness:inf", "layers:0", "layers:65", "layers:1.5", "solid:1"}) {
    EXPECT_FALSE(SettingText<Occluder>::parse(bad, &o)) << bad;
  }
}

TEST(Settings, StructsAreCheckedFieldByField) {
  LineSettings settings;
  EXPECT_TRUE(validate_ranges(settings).ok());
  settings.samples = 0;
  EXPECT_EQ(validate_ranges(settings).message(), "samples is 0; it must be in [1, 32]");
  settings.samples = 9;
  settings.falloff.radius = -1;
  EXPECT_EQ(validate_ranges(settings).code(), StatusCode::kInvalidArgument);
}

TEST(Settings, FalloffTablesAreChecked) {
  Falloff f{.kind = FalloffKind::kTable, .radius = 2, .table = {1, 0.5f, 0}};
  EXPECT_TRUE(validate(f).ok());
  f.table = {1};
  EXPECT_FALSE(validate(f).ok());
  f.table = {1, 2};
  EXPECT_FALSE(validate(f).ok());
  f.kind = FalloffKind::kFunction;
  EXPECT_FALSE(validate(f).ok());
}

}  // namespace
}  // namespace obscura
