// The default picture of one object, stored along every axis order, is the same: upright, and not
// mirrored.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "fmt/format.h"
#include "io/volumes/nrrd.h"
#include "io/volumes/vdb.h"
#include "scene/volumes/volume_view.h"
#include "tests/scene/volumes/volume_files.h"

namespace obscura::tools {
namespace {

constexpr int kSide = 31;
constexpr int kPicture = 96;
constexpr double kStep = 1.0 / (kSide - 1);

// A ball with three rods: thin to the right (+x), thicker to the front (+y), thickest up (+z).
// Positive in matter; patient space, the middle of the volume is 0.
double object(const Double3& p) {
  double most = 0.16 - std::hypot(p[0], p[1], p[2]);
  const double radius[3] = {0.05, 0.08, 0.12};
  for (int a = 0; a < 3; ++a) {
    const double along = std::clamp(p[a], 0.0, 0.36);
    Double3 d = p;
    d[a] -= along;
    most = std::max(most, radius[a] - std::hypot(d[0], d[1], d[2]));
  }
  return most;
}

// A place of the grid in the world: axes are steps from voxel to voxel, the middle voxel is at 0.
struct Grid {
  std::array<Double3, 3> axes;

  Double3 world(double i, double j, double k) const {
    const double at[3] = {i - (kSide - 1) / 2.0, j - (kSide - 1) / 2.0, k - (kSide - 1) / 2.0};
    Double3 p{};
    for (int a = 0; a < 3; ++a) {
      for (int w = 0; w < 3; ++w) p[w] += at[a] * axes[a][w];
    }
    return p;
  }
  // Samples of the object, x fastest; `turned` takes the world's points to those of the object.
  std::vector<float> samples(const std::function<Double3(const Double3&)>& turned) const {
    std::vector<float> values;
    for (int k = 0; k < kSide; ++k) {
      for (int j = 0; j < kSide; ++j) {
        for (int i = 0; i < kSide; ++i) values.push_back(float(object(turned(world(i, j, k)))));
      }
    }
    return values;
  }
};

Double3 same(const Double3& p) { return p; }

// Grid axes along `order` of the world's, each along (+1) or against (-1) it.
Grid grid_along(const std::array<int, 3>& order, unsigned flips) {
  Grid g{};
  for (int a = 0; a < 3; ++a) g.axes[a][order[a]] = flips >> a & 1 ? -kStep : kStep;
  return g;
}

class Orientation : public VolumeFileTest {
 protected:
  // The share of each pixel that the object covers in the default view.
  static std::vector<float> picture(const std::string& file) {
    VolumeImage image;
    const Status loaded = load_volume(file, {}, &image);
    EXPECT_TRUE(loaded.ok()) << loaded.message();
    std::vector<float> values(std::size_t(image.voxels()));
    const GridView<float> distance(values.data(), image.size, image.view().spacing);
    EXPECT_TRUE(sweep_distance(image.view(), {}, distance).ok());
    VolumeViewOptions options;
    options.size = {kPicture, kPicture};
    SurfaceCamera camera;
    EXPECT_TRUE(place_camera(image, distance, options, &camera).ok());
    std::vector<float> coverage(kPicture * kPicture);
    SurfaceOutputs outputs;
    outputs.coverage = {coverage.data(), kPicture, kPicture};
    EXPECT_TRUE(
        render_surface({image.view(), 0, SolidSide::kAbove, distance}, camera, {4}, {}, outputs)
            .ok());
    return coverage;
  }

  std::string nifti(const Grid& g, const std::string& name) const {
    NiftiBytes header(kSide, kSide, kSide, 16);
    header.put<std::int16_t>(254, 1);
    const Double3 origin = g.world(0, 0, 0);
    for (int w = 0; w < 3; ++w) {
      for (int a = 0; a < 3; ++a) header.put<float>(280 + 16 * w + 4 * a, float(g.axes[a][w]));
      header.put<float>(280 + 16 * w + 12, float(origin[w]));
    }
    return write(name, header.with(bytes_of_values(g.samples(same))));
  }

  std::string nrrd(const Grid& g, const std::string& space, const Double3& sign,
                   const std::string& name) const {
    auto vector = [&](const Double3& v) {
      return fmt::format("({},{},{})", v[0] * sign[0], v[1] * sign[1], v[2] * sign[2]);
    };
    const std::string header = fmt::format(
        "NRRD0004\ntype: float\ndimension: 3\nspace: {}\nsizes: {} {} {}\n"
        "space directions: {} {} {}\nspace origin: {}\nendian: little\nencoding: raw\n\n",
        space, kSide, kSide, kSide, vector(g.axes[0]), vector(g.axes[1]), vector(g.axes[2]),
        vector(g.world(0, 0, 0)));
    return write(name, header + bytes_of_values(g.samples(same)));
  }

  static double difference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]) / double(a.size());
    return sum;
  }
};

// How far the object reaches from the middle of its picture, and how thick it is a little inside
// its end, in pixels.
struct Arm {
  int end = -1;
  int thickness = 0;
};
Arm arm(const std::vector<float>& picture, bool along_x, bool from_high) {
  auto at = [&](int i, int j) {
    return picture[std::size_t(along_x ? j * kPicture + i : i * kPicture + j)] > 0.5f;
  };
  Arm result;
  for (int step = 0; step < kPicture; ++step) {
    const int i = from_high ? kPicture - 1 - step : step;
    int count = 0;
    for (int j = 0; j < kPicture; ++j) count += at(i, j);
    if (count == 0) continue;
    if (result.end < 0) result.end = step;
    if (step == result.end + 5) {
      result.thickness = count;
      break;
    }
  }
  return result;
}

// The camera looks into the face of a patient from the right: the right is to the left in the
// picture, the front to its right, and the head is up.
TEST_F(Orientation, RightIsLeftFrontIsRightAndUpIsUp) {
  const std::vector<float> p = picture(nifti(grid_along({0, 1, 2}, 0), "a.nii"));
  const Arm right = arm(p, true, false), front = arm(p, true, true), up = arm(p, false, false);
  const double pixels = kPicture * 0.84;  // of the object's longer side, about 0.65 long
  EXPECT_LT(right.thickness, front.thickness);
  EXPECT_LT(front.thickness, up.thickness);
  EXPECT_GT(up.thickness, 0.15 * pixels);
  EXPECT_LT(right.thickness, 0.25 * pixels);
}

TEST_F(Orientation, NiftiAlongEveryOrderOfAxes) {
  const std::vector<float> reference = picture(nifti(grid_along({0, 1, 2}, 0), "a.nii"));
  std::array<int, 3> order{0, 1, 2};
  do {
    for (unsigned flips = 0; flips < 8; ++flips) {
      const std::vector<float> p = picture(nifti(grid_along(order, flips), "b.nii"));
      EXPECT_LT(difference(p, reference), 1e-3) << order[0] << order[1] << order[2] << " " << flips;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  // The check itself: a mirrored object is another picture.
  std::vector<float> mirrored = reference;
  for (int y = 0; y < kPicture; ++y) {
    std::reverse(mirrored.begin() + y * kPicture, mirrored.begin() + (y + 1) * kPicture);
  }
  EXPECT_GT(difference(mirrored, reference), 0.05);
}

TEST_F(Orientation, NrrdInEverySpace) {
  const Grid g = grid_along({0, 1, 2}, 0), turned = grid_along({1, 2, 0}, 5);
  const std::vector<float> reference =
      picture(nrrd(g, "right-anterior-superior", {1, 1, 1}, "a.nrrd"));
  const Arm right = arm(reference, true, false), front = arm(reference, true, true);
  EXPECT_LT(right.thickness, front.thickness);
  for (const Grid& grid : {g, turned}) {
    for (const auto& [space, sign] : {std::pair{"RAS", Double3{1, 1, 1}},
                                      {"left-posterior-superior", {-1, -1, 1}},
                                      {"LPS", {-1, -1, 1}},
                                      {"left-anterior-superior", {-1, 1, 1}}}) {
      EXPECT_LT(difference(picture(nrrd(grid, space, sign, "b.nrrd")), reference), 1e-3) << space;
    }
  }
}

// In OpenVDB files y is up and +z the front, so that the object's right is -x.
TEST_F(Orientation, VdbWithARotation) {
  if (!has_openvdb()) GTEST_SKIP() << "this build has no OpenVDB";
  auto turned = [](const Double3& p) { return Double3{-p[0], p[2], p[1]}; };
  std::vector<float> reference;
  for (const double degrees : {0.0, 90.0, 180.0, 25.0}) {
    const double c = kStep * std::cos(degrees * std::numbers::pi / 180);
    const double s = kStep * std::sin(degrees * std::numbers::pi / 180);
    const Grid g{{{{c, s, 0}, {-s, c, 0}, {0, 0, kStep}}}};
    const NamedField field{"density", g.samples(turned)};
    ASSERT_TRUE(write_vdb(path("a.vdb"), {{kSide, kSide, kSide}, g.axes, g.world(0, 0, 0)},
                          std::span(&field, 1))
                    .ok());
    const std::vector<float> p = picture(path("a.vdb"));
    const Arm right = arm(p, true, false), front = arm(p, true, true), up = arm(p, false, false);
    EXPECT_LT(right.thickness, front.thickness) << degrees;
    EXPECT_LT(front.thickness, up.thickness) << degrees;
    if (reference.empty()) reference = p;
    // Between right angles the object is sampled elsewhere.
    EXPECT_LT(difference(p, reference), degrees == 25 ? 0.02 : 1e-3) << degrees;
  }
}

}  // namespace
}  // namespace obscura::tools
