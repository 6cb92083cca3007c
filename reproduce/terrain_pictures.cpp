// The pictures of docs/terrain.md: a hillfort, a city and mountains, made from formulas.
#include "reproduce/terrain.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "fmt/format.h"
#include "io/pictures/hill_shade.h"
#include "io/report/stopwatch.h"
#include "obscura/terrain.h"

namespace obscura::tools {
namespace {

constexpr int kSide = 320;

// Hash noise in [0, 1).
double noise_at(int x, int y, int seed) {
  auto h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
           static_cast<std::uint32_t>(y) * 0xd8163841u ^
           static_cast<std::uint32_t>(seed) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return (h ^ (h >> 15)) / 4294967296.0;
}

// Octaves of smooth noise whose amplitude falls with the period.
double relief(double x, double y, int longest, double amplitude, double roughness) {
  double z = 0;
  int seed = 1;
  for (int period = longest; period >= 1; period /= 2, amplitude *= roughness, ++seed) {
    const double u = x / period, v = y / period;
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    auto smooth = [](double t) { return t * t * (3 - 2 * t); };
    const double s = smooth(u - i), t = smooth(v - j);
    z += amplitude * ((1 - t) * ((1 - s) * noise_at(i, j, seed) + s * noise_at(i + 1, j, seed)) +
                      t * ((1 - s) * noise_at(i, j + 1, seed) + s * noise_at(i + 1, j + 1, seed)));
  }
  return z;
}

// A hill with two ramparts and ditches, gates, hut circles, barrows and old fields; cells of 1 m.
double hillfort(int column, int row) {
  const double x = column - 0.5 * kSide, y = row - 0.5 * kSide;
  const double r = std::hypot(x, 1.25 * y), angle = std::atan2(y, x);
  double z = 45 * std::exp(-r * r / (2 * 110 * 110)) + relief(column, row, 64, 1.2, 0.45);
  auto bell = [](double d, double width) { return std::exp(-d * d / (width * width)); };
  const double gate = std::min(std::fabs(angle - 0.4), std::fabs(angle + 2.6));
  const double wall = gate < 0.07 ? 0 : 1;
  for (const double ring : {84.0, 104.0}) {
    const double d = r - ring - 2 * std::sin(5 * angle);
    z += wall * (2.2 * bell(d, 3.5) - 1.6 * bell(d - 8, 3.5));
  }
  for (int i = 0; i < 14; ++i) {
    const double hx = 110 * (noise_at(i, 1, 9) - 0.5), hy = 90 * (noise_at(i, 2, 9) - 0.5);
    z += 0.35 * bell(std::hypot(x - hx, y - hy) - 5, 1.4);
  }
  for (const auto& barrow : {std::array{-128.0, 110.0}, {-104.0, 128.0}, {130.0, -118.0}}) {
    const double d = std::hypot(x - barrow[0], y - barrow[1]);
    z += 1.5 * bell(d, 7) - 0.5 * bell(d - 12, 2.5);
  }
  if (r > 122) z += 0.12 * std::sin(0.9 * (x * 0.8 + y * 0.6));
  return z;
}

// Blocks of houses along streets, some around courts; cells of 1 m.
double city(int column, int row) {
  const int i = column / 46, j = row / 58, x = column % 46, y = row % 58;
  const int street = i % 3 == 0 ? 18 : 11;
  if (x < street || y < 12) return 0;
  const double height = 9 + 18 * noise_at(i, j, 3);
  const int plot = (y - 12) / 12;
  const bool court = x > street + 9 && x < 37 && y > 24 && y < 46;
  if (court) return noise_at(i, j, 5) > 0.3 ? 0 : 4;
  if (noise_at(i, j, 8) > 0.9) return x > 24 && x < 40 && y > 24 && y < 40 ? 70 : 3;
  return height + 4 * noise_at(i * 7 + plot, j, 4);
}

// Cells of 30 m.
double mountains(int column, int row) {
  const double land = relief(column, row, 128, 1000, 0.4);
  const double valleys = std::fabs(std::sin(0.025 * column + 0.016 * row + land / 420));
  const double ravines = std::fabs(std::sin(0.11 * row - 0.06 * column + land / 130));
  return land + 900 * valleys + 160 * ravines * valleys;
}

struct Shown {
  const char* name;
  double (*height)(int column, int row);
  double cell;
  ImageView<float> TerrainOutputs::*quantity;
  int azimuths;
  double radius;
};

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr Shown kShown[] = {
    {"hillfort-svf", hillfort, 1, &TerrainOutputs::svf, 16, 10},
    {"hillfort-local-dominance", hillfort, 1, &TerrainOutputs::local_dominance, 16, kInfinite},
    {"city-svf", city, 1, &TerrainOutputs::svf, 64, kInfinite},
    {"city-svf-cosine", city, 1, &TerrainOutputs::svf_cosine, 64, kInfinite},
    {"mountains-svf-normal", mountains, 30, &TerrainOutputs::svf_normal, 32, kInfinite},
    {"mountains-openness", mountains, 30, &TerrainOutputs::openness, 32, kInfinite},
};

}  // namespace

Status reproduce_terrain_pictures(const ReproduceContext& context, Report* report,
                                  std::string* text) {
  *text += fmt::format("Models of {0} x {0} cells.\n", kSide);
  double share = 0;
  for (const Shown& shown : kShown) {
    if (!context.step(shown.name, share)) return {StatusCode::kCancelled, "stopped"};
    share += 1.0 / std::size(kShown);
    std::vector<float> heights(kSide * kSide), values(heights.size());
    for (int i = 0; i < kSide * kSide; ++i) {
      heights[i] = static_cast<float>(shown.height(i % kSide, i / kSide));
    }
    ElevationModel model;
    model.heights = {heights.data(), kSide, kSide};
    model.cell_width = model.cell_height = shown.cell;
    TerrainSettings settings;
    settings.azimuths = shown.azimuths;
    settings.radius = shown.radius;
    TerrainOutputs outputs;
    outputs.*shown.quantity = {values.data(), kSide, kSide};
    RunOptions run;
    run.threads = context.threads;
    const Stopwatch watch;
    if (Status s = compute_terrain(model, settings, outputs, run); !s.ok()) return s;
    report->add(shown.name, "time", 1e3 * watch.seconds(), "ms");
    if (Status s = context.picture(shown.name, hill_shade({values.data(), kSide, kSide}));
        !s.ok()) {
      return s;
    }
  }
  return {};
}

}  // namespace obscura::tools
