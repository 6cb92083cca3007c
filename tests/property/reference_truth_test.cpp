#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "obscura/estimator.h"
#include "paths.h"

namespace obscura {
namespace {

const std::filesystem::path kDepthImages = OBSCURA_SOURCE_DIR "/../shared/data/depth";

struct Pfm {
  int width = 0, height = 0;
  std::vector<float> values;
};

// Grey and little-endian, as these files are; rows go upwards.
Pfm read_pfm(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  double scale = 0;
  Pfm image;
  file >> magic >> image.width >> image.height >> scale;
  file.get();
  image.values.resize(static_cast<std::size_t>(image.width) * image.height);
  for (int y = image.height - 1; y >= 0; --y) {
    file.read(reinterpret_cast<char*>(&image.values[static_cast<std::size_t>(y) * image.width]),
              image.width * 4);
  }
  EXPECT_TRUE(file && magic == "Pf" && scale < 0) << path;
  return image;
}

struct Truth {
  const char* image;
  const char* truth;
  float radius;
};

// Depth images whose truth an independent tracer has found with 4,096 rays at every fifth pixel;
// of those, a ninth of a row and column here.
TEST(ReferenceTruth, AgreesWithAnIndependentTracer) {
  if (!std::filesystem::exists(kDepthImages)) {
    GTEST_SKIP() << "the depth images are not there: " << kDepthImages;
  }
  constexpr float kInf = std::numeric_limits<float>::infinity();
  for (const Truth& t : {Truth{"hall", "hall", 2}, Truth{"spheres", "spheres", 1},
                         Truth{"terrain", "terrain", 0.7f}, Truth{"hall", "hall.endless", kInf}}) {
    SCOPED_TRACE(t.truth);
    const Pfm depth = read_pfm(kDepthImages / (std::string(t.image) + ".pfm"));
    const Pfm truth = read_pfm(kDepthImages / (std::string(t.truth) + ".truth.pfm"));
    DepthField field;
    field.depth = {depth.values.data(), depth.width, depth.height};
    field.guard_band = GuardBand::symmetric(64, 36);
    const int w = field.visible().width, h = field.visible().height;
    field.camera =
        Camera::perspective_sensor(311.769f, static_cast<float>(h), w, h, field.guard_band);
    ReferenceSettings settings{.occluder = Occluder::solid()};
    settings.falloff.radius = t.radius;
    settings.rays = 4096;
    settings.every = 45;  // from 22: on the truth's lattice, 2, 7, 12, ...
    std::vector<float> visibility(static_cast<std::size_t>(w) * h);
    ASSERT_TRUE(compute(field, settings, {.visibility = {visibility.data(), w, h}}).ok());
    double error = 0, bias = 0;
    int pixels = 0;
    for (int y = 22; y < h; y += 45) {
      for (int x = 22; x < w; x += 45) {
        if (!std::isfinite(depth.values[static_cast<std::size_t>(y + 36) * depth.width + x + 64])) {
          continue;
        }
        const double d = visibility[static_cast<std::size_t>(y) * w + x] -
                         truth.values[static_cast<std::size_t>(y / 5) * truth.width + x / 5];
        error += std::abs(d);
        bias += d;
        ++pixels;
      }
    }
    EXPECT_GT(pixels, 50);
    EXPECT_LE(error / pixels, 0.003);
    EXPECT_LE(std::abs(bias / pixels), 0.0005);
  }
}

}  // namespace
}  // namespace obscura
