#include "obscura/methods.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <string>

#include "obscura/estimator.h"
#include "paths.h"

namespace obscura {
namespace {

TEST(Methods, EachIsFoundByItsName) {
  std::set<std::string_view> names;
  for_each_method([&](auto info, const auto& defaults) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    EXPECT_NE(std::string_view(info.summary), "");
    EXPECT_TRUE(std::filesystem::exists(std::string(OBSCURA_SOURCE_DIR) + "/" + info.page))
        << info.page;
    MethodSettings made;
    ASSERT_TRUE(make_settings(info.name, &made).ok());
    EXPECT_TRUE(std::holds_alternative<std::remove_cvref_t<decltype(defaults)>>(made));
    EXPECT_EQ(method_name(made), info.name);
  });
  EXPECT_EQ(method_names().size(), names.size());
}

TEST(Methods, AnUnknownNameIsToldOfTheOthers) {
  MethodSettings settings = LineSettings{.samples = 5};
  const Status s = make_settings("lines", &settings);
  EXPECT_EQ(s.code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(s.message(),
            "method is 'lines'; it must be one of area, far-field, hemisphere, horizon, line, "
            "mipmap, point, ray-traced");
  EXPECT_EQ(std::get<LineSettings>(settings).samples, 5);
}

TEST(Methods, DefaultsAreInRange) {
  for_each_method([](auto info, const auto& defaults) {
    EXPECT_TRUE(validate_ranges(defaults).ok()) << info.name;
    Estimator estimator;
    EXPECT_TRUE(Estimator::create(defaults, 32, 32, &estimator).ok()) << info.name;
  });
}

TEST(Methods, EveryFieldIsSetFromItsOwnText) {
  for (std::string_view name : method_names()) {
    MethodSettings settings;
    ASSERT_TRUE(make_settings(name, &settings).ok());
    const MethodSettings defaults = settings;
    std::set<std::string> fields;
    for_each_field(defaults, [&](const auto& value, const Field& field) {
      EXPECT_TRUE(fields.insert(field.name).second) << name << " " << field.name;
      const Status s = set(&settings, field.name, write_setting(value));
      EXPECT_TRUE(s.ok()) << name << ": " << s.message();
    });
  }
}

TEST(Methods, FieldsAreSetByName) {
  MethodSettings settings = FarFieldSettings{};
  EXPECT_TRUE(set(&settings, "radius", "2.5").ok());
  EXPECT_TRUE(set(&settings, "near_step", "0.5").ok());
  EXPECT_TRUE(set(&settings, "occluder", "thickness:0.1").ok());
  const auto& s = std::get<FarFieldSettings>(settings);
  EXPECT_EQ(s.falloff.radius, 2.5f);
  EXPECT_EQ(s.near_step, NearStep::of(0.5f));
  EXPECT_EQ(s.occluder.thickness, 0.1f);
  EXPECT_EQ(set(&settings, "near_step", "9").message(),
            "near_step is '9'; it must be adaptive or a number of pixels in [0.125, 8]");
  EXPECT_EQ(set(&settings, "directions", "3").message(),
            "directions is '3'; it must be a whole number in [4, 64]");
  EXPECT_EQ(s.directions, 16);
  settings = MipmapSettings{};
  EXPECT_EQ(set(&settings, "rays", "3").message(),
            "mipmap has no field 'rays'; it must be one of falloff, radius, directions, "
            "step_factor, pyramid, resolution");
}

}  // namespace
}  // namespace obscura
