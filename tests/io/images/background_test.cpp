#include "io/images/background.h"

#include <cmath>

#include "io/images/depth_file.h"
#include "io/images/describe.h"
#include "io/images/files.h"
#include "io/images/png.h"
#include "obscura/estimator.h"
#include "obscura/methods.h"
#include "tests/io/images/files_fixture.h"

// What renderers, depth cameras and rasters write where nothing is.
namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
constexpr int kWidth = 48, kHeight = 32;

// A tilted floor with a box before it, and `nothing` above.
Image scene(float nothing, float unit = 1, const char* name = "Z") {
  Image image(kWidth, kHeight);
  auto& depth = image.add(name);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      float d = y < 12 ? nothing : (4 + 0.05f * static_cast<float>(kHeight - y)) * unit;
      if (x > 18 && x < 30 && y > 8 && y < 24) d = 3.5f * unit;
      depth[static_cast<std::size_t>(y) * kWidth + x] = d;
    }
  }
  return image;
}

struct Loaded {
  Status status;
  DepthInput input;
};

class Background : public FilesTest {
 protected:
  Loaded load(const Image& image, DepthFileOptions o = {}, bool orthographic = false) {
    EXPECT_TRUE(write_image(path("d.exr"), image).ok());
    (orthographic ? o.ortho_height : o.fov_y) = orthographic ? 3 : 40;
    Loaded l;
    l.status = load_depth_input(path("d.exr"), o, &l.input);
    return l;
  }
  // Depths as they would be with +inf.
  static void expect_open(const DepthInput& input, float value) {
    const std::vector<float> right = scene(kInf).channels[0].values;
    EXPECT_EQ(input.depth, right) << value;
    ASSERT_EQ(input.notes.size(), 1u) << value;
  }
};

TEST_F(Background, WhatNoSceneHoldsIsBackgroundAndSaid) {
  for (const float value : {1e9f, 1e10f, 1e30f, 3.4e38f, -1e9f, -3.4e38f, 0.0f, -9999.0f, -1.0f,
                            65504.0f, 100.0f, 1000.0f}) {
    const Loaded l = load(scene(value));
    ASSERT_TRUE(l.status.ok()) << l.status.message();
    expect_open(l.input, value);
  }
  const Loaded l = load(scene(kInf));
  EXPECT_TRUE(l.input.notes.empty());
}

TEST_F(Background, EveryMethodGivesTheBitsOfInfinity) {
  const int w = kWidth, h = kHeight;
  for (const bool orthographic : {false, true}) {
    const Loaded right = load(scene(kInf), {}, orthographic);
    for (const float value : {1e10f, 65504.0f, -9999.0f}) {
      const Loaded l = load(scene(value), {}, orthographic);
      for_each_method([&](auto info, auto settings) {
        settings.falloff.radius = 1;
        std::vector<float> a(w * h), b(w * h);
        ASSERT_TRUE(compute(right.input.field(), settings, {.visibility = {a.data(), w, h}}).ok());
        ASSERT_TRUE(compute(l.input.field(), settings, {.visibility = {b.data(), w, h}}).ok());
        EXPECT_EQ(a, b) << info.name << " " << value;
      });
    }
  }
}

// The library takes arrays as they are; what no scene holds is background there too.
TEST_F(Background, DepthThatNoSceneHasIsBackgroundInTheLibrary) {
  const Image open = scene(kInf);
  DepthField field;
  field.depth = open.view(0);
  field.camera = Camera::perspective(0.7f, kWidth, kHeight);
  std::vector<float> a(kWidth * kHeight), b = a;
  FarFieldSettings settings;
  settings.falloff.radius = 1;
  ASSERT_TRUE(compute(field, settings, {.visibility = {a.data(), kWidth, kHeight}}).ok());
  for (const float value : {1e9f, 1e20f, 3.4e38f}) {
    const Image far = scene(value);
    field.depth = far.view(0);
    ASSERT_TRUE(compute(field, settings, {.visibility = {b.data(), kWidth, kHeight}}).ok());
    EXPECT_EQ(a, b) << value;
  }
}

TEST_F(Background, SurfacesStay) {
  // Not ten times as far, one pixel alone, or several values: a surface, silently.
  Loaded l = load(scene(40));
  EXPECT_EQ(l.input.depth[0], 40);
  EXPECT_TRUE(l.input.notes.empty());
  Image image = scene(kInf);
  image.channels[0].values[5] = 500;
  l = load(image);
  EXPECT_EQ(l.input.depth[5], 500);
  EXPECT_TRUE(l.input.notes.empty());
  // Asked to, the far plane and 0 stay as they are; 0 is then refused by the library.
  DepthFileOptions o;
  o.background.none = true;
  l = load(scene(1000), o);
  EXPECT_EQ(l.input.depth[0], 1000);
  EXPECT_EQ(load(scene(0), o).input.depth[0], 0);
}

TEST_F(Background, NamedValuesAreBackgroundOrHoles) {
  DepthFileOptions o;
  o.background.values = {7};
  Loaded l = load(scene(7), o);
  EXPECT_EQ(l.input.depth, scene(kInf).channels[0].values);
  o = {};
  o.invalid.values = {7};
  l = load(scene(7), o);
  EXPECT_EQ(l.input.depth, scene(kInf).channels[0].values);
  ASSERT_EQ(l.input.notes.size(), 1u);
  EXPECT_NE(l.input.notes[0].find("holes"), std::string::npos);
  ValueList list;
  ASSERT_TRUE(SettingText<ValueList>::parse("-9999,nan", &list));
  EXPECT_TRUE(list.contains(NAN));
  EXPECT_TRUE(list.contains(-9999));
  EXPECT_FALSE(list.contains(9999));
  for (const char* bad : {"", "x", "1,", ",1", "1;2"}) {
    EXPECT_FALSE(SettingText<ValueList>::parse(bad, &list)) << bad;
  }
}

TEST_F(Background, NegativeDepthIsTurned) {
  Image image = scene(kInf);
  for (float& v : image.channels[0].values) v = std::isinf(v) ? v : -v;
  const Loaded l = load(image);
  ASSERT_TRUE(l.status.ok());
  EXPECT_EQ(l.input.depth, scene(kInf).channels[0].values);
  EXPECT_NE(l.input.notes.at(0).find("sign"), std::string::npos);
}

TEST_F(Background, AnImageOfNothingIsRefused) {
  Image image = scene(kInf);
  for (float& v : image.channels[0].values) v = 0;
  const Loaded l = load(image);
  EXPECT_EQ(l.status.code(), StatusCode::kInvalidInput);
  EXPECT_NE(l.status.message().find("--background"), std::string::npos);
}

TEST_F(Background, InfoSaysWhatWouldBeRead) {
  ASSERT_TRUE(write_image(path("d.exr"), scene(1e10f)).ok());
  Json description;
  ASSERT_TRUE(describe_image(path("d.exr"), &description).ok());
  const std::string text = description_text(description);
  EXPECT_NE(text.find("are background"), std::string::npos) << text;
  EXPECT_NE(text.find("command: obscura ao " + path("d.exr") + " --fov-y"), std::string::npos)
      << text;
  Image image = scene(kInf);
  for (float& v : image.channels[0].values) v = 0;
  ASSERT_TRUE(write_image(path("d.exr"), image).ok());
  ASSERT_TRUE(describe_image(path("d.exr"), &description).ok());
  EXPECT_NE(description_text(description).find("problem: "), std::string::npos);
}

TEST_F(Background, MillimetresInAPng) {
  Image image = scene(0, 1000, "Y");
  for (float& v : image.channels[0].values) v = std::round(v) / 65535;
  std::string bytes;
  ASSERT_TRUE(encode_png(image, 16, &bytes).ok());
  write("d.png", bytes);
  DepthFileOptions o;
  o.fov_y = 40;
  o.depth_scale = 0.001;
  DepthInput input;
  ASSERT_TRUE(load_depth_input(path("d.png"), o, &input).ok());
  const std::vector<float> right = scene(kInf).channels[0].values;
  for (std::size_t i = 0; i < right.size(); ++i) {
    if (std::isinf(right[i])) {
      EXPECT_EQ(input.depth[i], right[i]);
    } else {
      EXPECT_NEAR(input.depth[i], right[i], 6e-4);
    }
  }
  o.depth_kind = FileDepthKind::kNdc;
  EXPECT_EQ(load_depth_input(path("d.png"), o, &input).code(), StatusCode::kInvalidArgument);
  EXPECT_EQ(load_depth_input(path("d.png"), {.fov_y = 40}, &input).code(),
            StatusCode::kInvalidArgument);
}

TEST_F(Background, InverseAndLogarithmicDepthBecomeLinear) {
  const std::vector<float> right = scene(kInf).channels[0].values;
  Image inverse = scene(kInf), logarithmic = scene(kInf);
  const float far = 200;
  for (std::size_t i = 0; i < right.size(); ++i) {
    inverse.channels[0].values[i] = std::isinf(right[i]) ? 0 : 1 / right[i];
    logarithmic.channels[0].values[i] =
        std::isinf(right[i]) ? 1 : std::log2(1 + right[i]) / std::log2(1 + far);
  }
  DepthFileOptions o;
  o.depth_kind = FileDepthKind::kInverse;
  const Loaded a = load(inverse, o);
  o.depth_kind = FileDepthKind::kLogarithmic;
  EXPECT_EQ(load(logarithmic, o).status.code(), StatusCode::kInvalidArgument);  // without far
  o.far = far;
  const Loaded b = load(logarithmic, o);
  for (const Loaded* l : {&a, &b}) {
    ASSERT_TRUE(l->status.ok()) << l->status.message();
    EXPECT_EQ(l->input.depth_kind, DepthKind::kLinear);
    for (std::size_t i = 0; i < right.size(); ++i) {
      if (std::isinf(right[i])) {
        EXPECT_EQ(l->input.depth[i], right[i]);
      } else {
        EXPECT_NEAR(l->input.depth[i], right[i], 2e-5 * right[i]);
      }
    }
  }
}

}  // namespace
}  // namespace obscura::tools
