#include "obscura/terrain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/reference/terrain.h"

// Surfaces whose horizons are known.
namespace obscura {
namespace {

using reference::Model;
constexpr double kPi = std::numbers::pi;
constexpr double kSlope30 = 0.57735026918962576;

struct Result {
  explicit Result(const Model& m) : width(m.width) {
    for (auto* v : {&svf, &svf_normal, &svf_cosine, &openness, &negative, &visible}) {
      v->assign(m.heights.size(), -1.0f);
    }
  }
  TerrainOutputs outputs() {
    const int height = int(svf.size()) / width;
    auto view = [&](std::vector<float>& v) { return ImageView<float>(v.data(), width, height); };
    TerrainOutputs o;
    o.svf = view(svf);
    o.svf_normal = view(svf_normal);
    o.svf_cosine = view(svf_cosine);
    o.openness = view(openness);
    o.negative_openness = view(negative);
    o.visible_sky = view(visible);
    return o;
  }
  std::size_t at(int x, int y) const { return std::size_t(y) * width + x; }

  int width;
  std::vector<float> svf, svf_normal, svf_cosine, openness, negative, visible;
};

Result computed(const Model& m, int azimuths, TerrainSettings settings = {}) {
  settings.azimuths = azimuths;
  Result r(m);
  const Status s = compute_terrain(m.view(), settings, r.outputs());
  EXPECT_TRUE(s.ok()) << s.message();
  return r;
}

// Mean over the azimuths of a function of the horizon's angle above the horizontal.
template <class F>
double mean(int azimuths, F&& f) {
  double sum = 0;
  for (int k = 0; k < azimuths; ++k) sum += f(2 * kPi * k / azimuths);
  return sum / azimuths;
}

TEST(Terrain, FlatGroundIsOpen) {
  Model m(40, 30);
  m.fill([](double, double) { return 812.5; });
  const Result r = computed(m, 16);
  for (std::size_t i = 0; i < r.svf.size(); ++i) {
    ASSERT_FLOAT_EQ(r.svf[i], 1);
    ASSERT_FLOAT_EQ(r.svf_normal[i], 1);
    ASSERT_FLOAT_EQ(r.svf_cosine[i], 1);
    ASSERT_FLOAT_EQ(r.openness[i], 90);
    ASSERT_FLOAT_EQ(r.negative[i], 90);
    ASSERT_FLOAT_EQ(r.visible[i], 100);
  }
}

// A plane of slope b sees tan gamma = tan b cos(phi - uphill). Its own light is (1 + cos b) / 2.
TEST(Terrain, PlaneHasItsOwnHorizon) {
  for (const auto& cell : {std::array<double, 2>{1, 1}, {2, 3}, {5, 0.5}}) {
    for (const double uphill : {0.0, 0.5 * kPi, 1.25 * kPi, 0.3}) {
      Model m(61, 61, cell[0], cell[1]);
      m.fill([&](double e, double n) {
        return 100 + kSlope30 * (e * std::sin(uphill) + n * std::cos(uphill));
      });
      for (const int azimuths : {16, 64}) {
        const Result r = computed(m, azimuths);
        auto gamma = [&](double phi) {
          return std::max(0.0, std::atan(kSlope30 * std::cos(phi - uphill)));
        };
        const std::size_t middle = r.at(30, 30);
        EXPECT_NEAR(r.svf[middle], 1 - mean(azimuths, [&](double p) { return std::sin(gamma(p)); }),
                    1e-4);
        EXPECT_NEAR(r.svf_cosine[middle],
                    mean(azimuths, [&](double p) { return std::pow(std::cos(gamma(p)), 2); }),
                    1e-4);
        EXPECT_NEAR(r.svf_normal[middle], 0.9330, 2e-3);
        EXPECT_NEAR(r.openness[middle], 90, 0.01);
        EXPECT_NEAR(r.negative[middle], 90, 0.01);
      }
    }
  }
}

TEST(Terrain, PlaneOf30DegreesHasTheFiguresOfTheLiterature) {
  Model m(61, 61);
  m.fill([](double, double n) { return kSlope30 * n; });
  EXPECT_NEAR(computed(m, 16).svf[30 * 61 + 30], 0.8357, 1e-4);
  EXPECT_NEAR(computed(m, 720).svf[30 * 61 + 30], 0.8333, 1e-4);
  EXPECT_NEAR(computed(m, 720).svf_normal[30 * 61 + 30], 0.9330, 1e-4);
}

// From the apex of a conical pit all horizons are its slope. The pit is flat near the apex, where
// cells are too coarse for a cone.
TEST(Terrain, ConePit) {
  Model m(161, 161);
  m.fill([](double e, double n) {
    const double r = std::hypot(e, n);
    return r < 7 ? 0 : kSlope30 * r;
  });
  const Result r = computed(m, 16);
  const std::size_t apex = r.at(80, 80);
  EXPECT_NEAR(r.svf[apex], 0.5, 3e-3);
  EXPECT_NEAR(r.svf_normal[apex], 0.75, 3e-3);
  EXPECT_NEAR(r.svf_cosine[apex], 0.75, 3e-3);
  EXPECT_NEAR(r.openness[apex], 60, 0.2);
  EXPECT_NEAR(r.visible[apex], 100 * (1 - 30.0 / 90), 0.2);
}
TEST(Terrain, NegativeOpennessLooksDown) {
  Model m(161, 161);
  m.fill([](double e, double n) { return kSlope30 * std::hypot(e, n); });
  const Result r = computed(m, 16);
  // Turned upside down the pit is a cone, whose horizon falls off on every side.
  EXPECT_NEAR(r.negative[r.at(80, 80)], 120, 0.1);
}

// On the floor of a V of slopes b: tan gamma = tan b |sin phi|.
TEST(Terrain, ValleyFloor) {
  struct Case {
    double b, openness;
  };
  for (const Case& c : {Case{30, 70.29}, Case{45, 59.17}}) {
    const double b = c.b * kPi / 180;
    Model m(101, 201);
    m.fill([&](double e, double) { return std::tan(b) * std::fabs(e); });
    const Result r = computed(m, 360);
    const std::size_t floor = r.at(50, 100);
    EXPECT_NEAR(r.svf[floor], 1 - 2 * b / kPi, 1e-3) << c.b;
    EXPECT_NEAR(r.openness[floor], c.openness, 0.06) << c.b;
  }
}

// Lines are sampled once a column, so a wall seen at a slant begins up to a column late: the error
// falls with its distance in cells.
TEST(Terrain, WallAsHighAsItIsFar) {
  Model m(1001, 101);
  m.fill([](double, double n) { return n >= 40 ? 40 : 0; });
  EXPECT_NEAR(computed(m, 360).svf[50 * 1001 + 500], 0.75, 2e-3);
  Model turned(101, 1001);
  turned.fill([](double e, double) { return e >= 40 ? 40 : 0; });
  EXPECT_NEAR(computed(turned, 360).svf[500 * 101 + 50], 0.75, 2e-3);
}

// A tower in the plain, `distance` away: its angle tells how much of it the earth's bulge hides.
double hidden_by_earth(double distance, double refraction, bool to_the_north, bool upright) {
  const double cell = 1000, tower = 2000;
  const int cells = int(distance / cell);
  Model m(upright ? 9 : 140, upright ? 140 : 9, cell, cell);
  const int viewer = 70, target = to_the_north ? 70 - cells : 70 + cells;
  if (upright) {
    m(4, target) = float(tower);
  } else {
    m(target, 4) = float(tower);
  }
  TerrainSettings settings;
  settings.azimuths = 4;
  settings.curvature = true;
  settings.refraction = refraction;
  std::vector<std::vector<float>> bands(4, std::vector<float>(m.heights.size()));
  std::vector<ImageView<float>> views;
  for (auto& b : bands) views.emplace_back(b.data(), m.width, m.height);
  TerrainOutputs outputs;
  outputs.horizon = views;
  const Status s = compute_terrain(m.view(), settings, outputs);
  EXPECT_TRUE(s.ok()) << s.message();
  const int band = upright ? (to_the_north ? 0 : 2) : (to_the_north ? 3 : 1);
  const float gamma = upright ? views[band](4, viewer) : views[band](viewer, 4);
  return tower - distance * std::tan(gamma * kPi / 180);
}

TEST(Terrain, CurvatureAndRefraction) {
  for (const bool north : {true, false}) {
    for (const bool upright : {true, false}) {
      EXPECT_NEAR(hidden_by_earth(10000, 0, north, upright), 7.85, 0.02);
      EXPECT_NEAR(hidden_by_earth(50000, 0, north, upright), 196.2, 0.2);
      EXPECT_NEAR(hidden_by_earth(10000, 0.13, north, upright), 6.83, 0.02);
      EXPECT_NEAR(hidden_by_earth(50000, 0.13, north, upright), 170.7, 0.2);
    }
  }
}

TEST(Terrain, HorizonBandsCountClockwiseFromNorth) {
  Model m(41, 41);
  m(20, 10) = 10;  // north
  m(30, 20) = 20;  // east
  m(20, 30) = 30;  // south
  m(10, 20) = 40;  // west
  std::vector<std::vector<float>> bands(4, std::vector<float>(m.heights.size()));
  std::vector<ImageView<float>> views;
  for (auto& b : bands) views.emplace_back(b.data(), m.width, m.height);
  TerrainOutputs outputs;
  outputs.horizon = views;
  TerrainSettings settings;
  settings.azimuths = 4;
  ASSERT_TRUE(compute_terrain(m.view(), settings, outputs).ok());
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(views[k](20, 20), std::atan(1.0 + k) * 180 / kPi, 1e-3) << k;
  }
}

TEST(Terrain, ZFactorScalesHeights) {
  Model metres(31, 31), feet(31, 31);
  metres.fill([](double e, double n) { return 2 * std::sin(e / 3) + std::cos(n / 4); });
  for (std::size_t i = 0; i < feet.heights.size(); ++i) {
    feet.heights[i] = metres.heights[i] / 0.3048f;
  }
  TerrainSettings settings;
  settings.z_factor = 0.3048;
  const Result a = computed(metres, 8), b = computed(feet, 8, settings);
  for (std::size_t i = 0; i < a.svf.size(); ++i) ASSERT_NEAR(a.svf[i], b.svf[i], 1e-5);
}

}  // namespace
}  // namespace obscura
