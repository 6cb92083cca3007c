#include "terrain/directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace obscura {
namespace {

constexpr double kEarthRadius = 6371000;  // metres
// Near the viewer, heights between the lines and along them matter most: samples are taken from the
// cell itself, every half row so far.
constexpr int kFineRows = 4;
// Slopes that differ by less are those of one plane: what rounding does to heights of a kilometre
// on cells of a metre.
constexpr double kSameSlope = 2e-4;

NearSample near_sample(double rows, double shear, double step, double earth) {
  NearSample sample;
  sample.back = static_cast<int>(std::ceil(rows));
  sample.half = sample.back != rows;
  // On a cell but for rounding is on it: else it would mix with a cell without data beside it.
  const double exact = -shear * rows, nearest = std::round(exact);
  const double column = std::fabs(exact - nearest) < 1e-6 ? nearest : exact;
  sample.column = static_cast<int>(std::floor(column));
  sample.fraction = static_cast<float>(column - sample.column);
  const double distance = rows * step;
  sample.inverse_distance = static_cast<float>(1 / distance);
  sample.drop = static_cast<float>(distance / (2 * earth));
  return sample;
}

// On a round earth ground at the distance s lies s^2 / (2 R') lower, R' = R / (1 - k) with the
// refraction k. Heights less y^2 / (2 R'), with the position y along the sweep, have the same
// horizons; their slopes, seen back along the sweep, are larger by y / R'.
void bend_rows(TerrainDirection* direction) {
  for (int row = 0; row < direction->sweep.height; ++row) {
    direction->row_offset.push_back(static_cast<float>(direction->offset(row)));
    direction->row_slope.push_back(static_cast<float>(direction->position(row) / direction->earth));
  }
}

// Weights of the azimuths in the anisotropic sky-view factor; their mean is 1.
std::vector<double> anisotropic_weights(const TerrainSettings& settings) {
  const bool high = settings.asvf_level == Anisotropy::kHigh;
  const double least = high ? 0.1 : 0.4, power = high ? 8 : 4;
  std::vector<double> weights(settings.azimuths);
  double sum = 0;
  for (int k = 0; k < settings.azimuths; ++k) {
    const double angle = 2 * std::numbers::pi * k / settings.azimuths -
                         settings.asvf_direction * std::numbers::pi / 180;
    weights[k] = least + (1 - least) * std::pow(std::cos(0.5 * angle), power);
    sum += weights[k];
  }
  for (double& w : weights) w *= settings.azimuths / sum;
  return weights;
}

}  // namespace

std::vector<TerrainDirection> terrain_directions(Extent size, double cell_width, double cell_height,
                                                 const TerrainSettings& settings) {
  const double earth = settings.curvature ? kEarthRadius / (1 - settings.refraction)
                                          : std::numeric_limits<double>::infinity();
  const std::vector<double> weights = anisotropic_weights(settings);
  std::vector<TerrainDirection> directions(settings.azimuths);
  for (int k = 0; k < settings.azimuths; ++k) {
    TerrainDirection& d = directions[k];
    const double azimuth = 2 * std::numbers::pi * k / settings.azimuths;
    // In columns and rows for each unit of the way.
    double across = std::sin(azimuth) / cell_width;
    double down = -std::cos(azimuth) / cell_height;
    double cell_across = cell_width, cell_down = cell_height;
    d.index = k;
    d.sweep.weight = static_cast<float>(weights[k]);
    d.transposed = std::fabs(across) > std::fabs(down) * (1 + 1e-9);
    if (d.transposed) {
      std::swap(across, down);
      std::swap(cell_across, cell_down);
    }
    // What is left of a multiple of pi.
    if (std::fabs(across) < 1e-12 * std::fabs(down)) across = 0;
    TerrainSweep& s = d.sweep;
    s.width = d.transposed ? size.height : size.width;
    s.height = d.whole_rows = d.transposed ? size.width : size.height;
    s.reversed = down > 0;
    s.shear = -across / std::fabs(down);
    const double step = 1 / std::fabs(down);
    s.inverse_step = static_cast<float>(1 / step);
    s.same_rise = static_cast<float>(kSameSlope * step);
    s.towards_column = static_cast<float>(across);
    s.towards_row = static_cast<float>(down);
    s.inverse_width = static_cast<float>(1 / cell_across);
    s.inverse_height = static_cast<float>(1 / cell_down);

    // A radius given as so many rows is not to lose the last to rounding.
    const double rows = std::min<double>(s.height, settings.radius / step * (1 + 1e-9));
    const int whole = static_cast<int>(rows);
    const bool marched = whole <= kMostMarched && whole < s.height;
    for (int half = 1; half <= 2 * std::min(whole, kFineRows); ++half) {
      d.near.push_back(near_sample(0.5 * half, s.shear, step, earth));
    }
    for (int row = kFineRows + 1; marched && row <= whole; ++row) {
      d.near.push_back(near_sample(row, s.shear, step, earth));
    }
    s.window = marched ? 0 : whole;
    s.marched_rows = marched ? whole : kFineRows;
    d.step = step;
    d.earth = earth;
    if (settings.curvature) bend_rows(&d);
  }
  return directions;
}

}  // namespace obscura
