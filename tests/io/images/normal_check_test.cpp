#include "io/images/normal_check.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "io/images/depth_file.h"
#include "io/images/files.h"
#include "io/images/rotation_fit.h"
#include "scene/scenes/load_scene.h"
#include "tests/io/images/files_fixture.h"

namespace obscura::tools {
namespace {

using Matrix3 = std::array<std::array<double, 3>, 3>;

// From a world to eye space: a camera at `pitch` above the horizon that turns by `heading`, in
// degrees, in a world whose z (or y) is up.
Matrix3 world_to_eye(double pitch, double heading, bool z_up) {
  const double p = pitch * M_PI / 180, h = heading * M_PI / 180;
  // Rows: right, up, back, in a world with y up.
  const std::array<double, 3> right{std::cos(h), 0, std::sin(h)};
  const std::array<double, 3> up{std::sin(p) * std::sin(h), std::cos(p),
                                 -std::sin(p) * std::cos(h)};
  const std::array<double, 3> back{-std::cos(p) * std::sin(h), std::sin(p),
                                   std::cos(p) * std::cos(h)};
  Matrix3 m{right, up, back};
  if (z_up) {  // its x, y, z are ours x, -z, y
    for (auto& row : m) row = {row[0], -row[2], row[1]};
  }
  return m;
}

class Normals : public FilesTest {
 protected:
  // A scene's depth and normals, which `change` may spoil, as an EXR file.
  template <class Change>
  void write_scene(const std::string& scene, Change change) {
    DepthInput truth;
    ASSERT_TRUE(load_scene("scene:" + scene + "?size=160x90&guard-band=0", &truth).ok());
    camera_ = truth.camera;
    Image image(truth.width, truth.height);
    image.add("Z") = truth.depth;
    std::array<std::vector<float>, 3> n{truth.normal_x, truth.normal_y, truth.normal_z};
    truth_ = n;
    for (std::size_t i = 0; i < n[0].size(); ++i) {
      const std::array<double, 3> v = change(std::array<double, 3>{n[0][i], n[1][i], n[2][i]});
      for (int c = 0; c < 3; ++c) n[c][i] = static_cast<float>(v[c]);
    }
    const char* names[] = {"N.X", "N.Y", "N.Z"};
    for (int c = 0; c < 3; ++c) image.add(names[c]) = n[c];
    ASSERT_TRUE(write_image(path("g.exr"), image).ok());
  }
  Status load(DepthFileOptions o, DepthInput* input) {
    o.fov_y = 2 * std::atan(0.5 * 90 * camera_.scale_y) * 180 / M_PI;
    return load_depth_input(path("g.exr"), o, input);
  }
  // The mean angle to the right normals, in degrees.
  double error(const DepthInput& input) const {
    double sum = 0;
    int count = 0;
    for (std::size_t i = 0; i < truth_[0].size(); ++i) {
      const double d = input.normal_x[i] * truth_[0][i] + input.normal_y[i] * truth_[1][i] +
                       input.normal_z[i] * truth_[2][i];
      const double l =
          std::sqrt(input.normal_x[i] * input.normal_x[i] + input.normal_y[i] * input.normal_y[i] +
                    input.normal_z[i] * input.normal_z[i]);
      if (!(input.depth[i] < 1e9f) || !(l > 0)) continue;
      sum += std::acos(std::clamp(d / l, -1.0, 1.0));
      ++count;
    }
    return sum / count * 180 / M_PI;
  }

  Camera camera_;
  std::array<std::vector<float>, 3> truth_;
};

constexpr const char* kScenes[] = {"hall", "tower", "cornell", "meadow"};

TEST_F(Normals, RightOnesAreNotAccused) {
  for (const char* scene : kScenes) {
    // As they are, of any length, and with bumps.
    for (const double bumps : {0.0, 0.2, 0.4}) {
      int i = 0;
      write_scene(scene, [&](std::array<double, 3> n) {
        ++i;
        for (int c = 0; c < 3; ++c) n[c] = 3 * (n[c] + bumps * std::sin(12.9898 * i + 78.2 * c));
        return n;
      });
      DepthInput input;
      const Status s = load({}, &input);
      ASSERT_TRUE(s.ok()) << scene << bumps << s.message();
      EXPECT_FALSE(input.normal_x.empty()) << scene << bumps;
      EXPECT_TRUE(input.notes.empty()) << input.notes[0];
    }
  }
}

TEST_F(Normals, SignsAndPackingAreMended) {
  struct Case {
    std::array<double, 3> sign;
    bool packed;
    const char* word;
  };
  for (const char* scene : {"hall", "tower", "cornell"}) {
    for (const Case& c : {Case{{-1, -1, -1}, false, "negated"},
                          {{1, 1, -1}, false, "z into the scene"},
                          {{1, -1, 1}, false, "y downwards"},
                          {{1, 1, 1}, true, "packed"}}) {
      write_scene(scene, [&](std::array<double, 3> n) {
        for (int i = 0; i < 3; ++i) n[i] = c.packed ? n[i] / 2 + 0.5 : c.sign[i] * n[i];
        return n;
      });
      DepthInput input;
      const Status s = load({}, &input);
      ASSERT_TRUE(s.ok()) << scene << s.message();
      ASSERT_EQ(input.notes.size(), 1u) << scene << c.word;
      EXPECT_NE(input.notes[0].find(c.word), std::string::npos) << input.notes[0];
      EXPECT_LT(error(input), 0.5) << scene << c.word;
      // Believed, they are what they are.
      DepthFileOptions o;
      o.normal_space = NormalSpace::kView;
      ASSERT_TRUE(load(o, &input).ok());
      EXPECT_TRUE(input.notes.empty());
      EXPECT_GT(error(input), 15);
    }
  }
}

TEST_F(Normals, WorldSpaceIsNoticedAndTurnedWhereTheMatrixIsGiven) {
  for (const char* scene : {"hall", "tower", "cornell"}) {
    for (const bool z_up : {false, true}) {
      const Matrix3 m = world_to_eye(25, 40, z_up);
      write_scene(scene, [&](std::array<double, 3> n) {
        std::array<double, 3> world{};
        for (int i = 0; i < 3; ++i) {
          for (int j = 0; j < 3; ++j) world[j] += m[i][j] * n[i];
        }
        return world;
      });
      DepthInput input;
      Status s = load({}, &input);
      ASSERT_TRUE(s.ok()) << scene << s.message();
      EXPECT_TRUE(input.normal_x.empty());
      ASSERT_EQ(input.notes.size(), 1u);
      const char* words = z_up ? "world space (z up)" : "world space (y up)";
      EXPECT_NE(input.notes[0].find(words), std::string::npos) << input.notes[0];
      std::string matrix, transposed;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          matrix += std::to_string(m[i][j]) + " ";
          transposed += std::to_string(m[j][i]) + " ";
        }
      }
      write("m.txt", matrix);
      DepthFileOptions o;
      o.world_to_camera = path("m.txt");
      s = load(o, &input);
      ASSERT_TRUE(s.ok()) << scene << s.message();
      EXPECT_TRUE(input.notes.empty());
      EXPECT_LT(error(input), 0.5);
      write("m.txt", transposed);
      s = load(o, &input);
      EXPECT_EQ(s.code(), StatusCode::kInvalidInput) << scene << z_up;
      EXPECT_NE(s.message().find("transposed"), std::string::npos) << s.message();
    }
  }
}

TEST_F(Normals, WhatNothingExplainsIsRefused) {
  int i = 0;
  write_scene("hall", [&](std::array<double, 3>) {
    ++i;
    return std::array<double, 3>{std::sin(12.9 * i), std::sin(78.2 * i), std::sin(37.7 * i)};
  });
  DepthInput input;
  const Status s = load({}, &input);
  EXPECT_EQ(s.code(), StatusCode::kInvalidInput);
  EXPECT_NE(s.message().find("--normals depth"), std::string::npos) << s.message();
  DepthFileOptions o;
  o.normals = "depth";
  ASSERT_TRUE(load(o, &input).ok());
  EXPECT_TRUE(input.normal_x.empty());
}

TEST(RotationFit, FindsRotationsAndMirrors) {
  for (const bool mirror : {false, true}) {
    const Matrix3 r = world_to_eye(30, 70, false);
    double m[3][3];
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m[i][j] = r[i][j] * (j + 1) * 0.2 * (mirror && i == 2 ? -1 : 1);
    }
    const auto fit = fit_rotation(m);
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->mirrored, mirror);
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        EXPECT_NEAR(fit->matrix[i][j], r[i][j] * (mirror && i == 2 ? -1 : 1), 1e-9);
      }
    }
  }
  const double flat[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  EXPECT_FALSE(fit_rotation(flat));
}

}  // namespace
}  // namespace obscura::tools
