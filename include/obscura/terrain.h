#ifndef OBSCURA_TERRAIN_H_
#define OBSCURA_TERRAIN_H_

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "obscura/export.h"
#include "obscura/run_options.h"
#include "obscura/settings.h"
#include "obscura/status.h"
#include "obscura/views.h"

// Ambient visibility of elevation models: sky-view factor, openness and horizons. Arrays in, arrays
// out.
//
// gamma(phi) is the elevation angle of the horizon seen from a cell's ground towards the azimuth
// phi, signed: below the horizontal it is negative. gamma+ is max(gamma, 0). Azimuths count
// clockwise from north; row 0 of a raster is its northern edge and column 0 its western one. K
// azimuths are 360 / K degrees apart, the first is north. A direction in which there are no data
// has gamma = 0.
//
// Angles are in degrees here, as in every tool of the field.

namespace obscura {

// The land around a model that is a tile of a larger one, in cells so coarse that they are small
// against their distance; coarsen_terrain makes them. Without heights: only where the tile lies, so
// that its lines are those of the larger model.
struct TerrainSurround {
  ImageView<const float> heights;  // of the larger model; NaN: no data
  int factor = 1;                  // [1, 65536] cells of the model along a coarse one
  // Cells of the larger model, 0: none, and from its first cell to that of the tile.
  std::int64_t width = 0, height = 0, column = 0, row = 0;
};

// Part of a model.
struct TerrainWindow {
  int x = 0, y = 0, width = 0, height = 0;
};

// Heights beyond this have no data.
inline constexpr float kMostTerrainHeight = 1e9f;

// Cells along a side of a model, at most.
inline constexpr int kMostTerrainCells = 1 << 18;

// Caller-owned heights of a regular grid.
struct ElevationModel {
  // [1, 262144] cells a side, in the unit of the cells' sides times 1 / z_factor. Cells that are
  // NaN, infinite or beyond kMostTerrainHeight in magnitude have no data.
  ImageView<const float> heights;
  double cell_width = 1, cell_height = 1;  // [1e-4, 1e6] world units, west to east, north to south
  std::optional<float> nodata{};           // cells of this value have no data
  // None, or one per row in place of cell_width: cells of a geographic grid, which narrow towards
  // the poles. Lines are then those of the row that they end in, to 1 % of the width: the model is
  // swept once for each band of rows in which widths differ by less than 2 %. A tile may have those
  // of the larger model's rows.
  std::span<const double> row_widths{};
  // For tiles. Where results are wanted: the rest of the heights is a halo around them, that hides
  // the sky only. Of width 0: everywhere.
  TerrainWindow inner{};
  // What lies beyond the heights and hides the sky, too. Its heights need a radius of infinity.
  // With a finite one, a halo one cell wider than the radius and the same datum, a tile has the
  // bits of the larger model.
  TerrainSurround surround{};
  // Taken from heights before they are rounded; none: the first height. For parts of one model that
  // are to have the same bits.
  std::optional<double> datum{};
};

// How much of the sky's light comes from the side of asvf_direction: the least weight of an azimuth
// is 0.4 or 0.1, and weights follow the 4th or 8th power of the cosine of half the angle between.
enum class Anisotropy { kLow, kHigh };
template <>
struct EnumNames<Anisotropy> {
  static constexpr const char* names[] = {"low", "high"};
};

struct TerrainSettings {
  int azimuths = 16;
  double radius = std::numeric_limits<double>::infinity();
  double z_factor = 1;
  bool curvature = false;
  double refraction = 0;
  double asvf_direction = 315;
  Anisotropy asvf_level = Anisotropy::kLow;
  int dominance_from = 10, dominance_to = 20;
  double observer_height = 1.7;
};
template <FieldsOf<TerrainSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.azimuths, Field{"azimuths", "", closed(1, 3600), "Directions in which horizons are found."});
  v(s.radius, Field{"radius", "world units", positive_or_infinite(),
                    "How far away ground may hide the sky."});
  v(s.z_factor, Field{"z_factor",
                      "",
                      {1e-6, 1e6},
                      "Heights are multiplied by this; 0.3048 for feet over metres."});
  v(s.curvature, Field{"curvature",
                       "",
                       {},
                       "Take the curvature of the earth into account; world units are metres."});
  v(s.refraction, Field{"refraction",
                        "",
                        {0, 1, false, true},
                        "Of light by air, with curvature: the earth's radius grows by "
                        "1 / (1 - refraction); 0.13 is usual."});
  v(s.asvf_direction, Field{"asvf_direction",
                            "degrees",
                            {0, 360},
                            "Azimuth from which asvf has most light, clockwise from north."});
  v(s.asvf_level, Field{"asvf_level", "", {}, "How much of asvf's light comes from there."});
  v(s.dominance_from, Field{"dominance_from", "cells", closed(1, 60),
                            "Inner radius of the ring that local dominance looks at."});
  v(s.dominance_to, Field{"dominance_to", "cells", closed(1, 60), "Its outer radius."});
  v(s.observer_height,
    Field{
        "observer_height", "world units", {1e-3, 1e6}, "Height from which local dominance looks."});
}

// Caller-owned results, each as large as the model or its inner part; those that are empty are not
// computed. Cells without data become NaN. Means are over the K azimuths.
struct TerrainOutputs {
  // Share of the sky that is visible, seen as a horizontal hemisphere: 1 - mean(sin gamma+)
  // (Zaksek, Ostir and Kokalj 2011, equation 4). In [0, 1].
  ImageView<float> svf;
  // Share of the light of a uniform sky that reaches the sloping ground (Dozier and Frew 1990,
  // equation 7b): mean(cos b cos^2 g + sin b cos(phi - a) (pi/2 - g - sin g cos g)) with the slope
  // b, the aspect a and g = max(gamma, 0, angle of the tangent plane). In [0, 1].
  ImageView<float> svf_normal;
  // Share of the light of a uniform sky on horizontal ground: mean(cos^2 gamma+). In [0, 1].
  ImageView<float> svf_cosine;
  // Positive openness: mean(90 - gamma) (Yokoyama, Shirasawa and Pike 2002). [0, 180] degrees.
  ImageView<float> openness;
  // Openness of the model turned upside down. [0, 180] degrees.
  ImageView<float> negative_openness;
  // Share of the elevation angles that are open: 100 mean(1 - gamma+ / 90). In [0, 100] percent.
  ImageView<float> visible_sky;
  // As svf, with a weight per azimuth phi: least + (1 - least) cos^n((phi - asvf_direction) / 2),
  // that is more light from one side (Relief Visualization Toolbox). In [0, 1].
  ImageView<float> asvf;
  // How far a viewer at observer_height looks down on the ring from dominance_from to dominance_to
  // (Hesse 2016; Relief Visualization Toolbox): sum of max(0, z + h - z') (2 d + 1) / d over its
  // cells, every 15 degrees and every cell's length d, divided by that of flat ground, 1.
  ImageView<float> local_dominance;
  // None, or one image per azimuth, in their order: gamma. [-90, 90] degrees.
  std::span<const ImageView<float>> horizon{};
};

// Computes what `outputs` asks for, in one or two passes over the model for each azimuth.
//
// Horizons are those of lines through the grid, with heights interpolated linearly between
// neighbouring cells of a row or of a column. Every row (or column) that a line crosses is taken
// into account, however far, out to `radius`; within four rows, samples lie half a row apart.
//
// Guarantees: the same bits for any number of threads.
// Requires: outputs of the model's size that overlap neither each other nor the model.
OBSCURA_API Status compute_terrain(const ElevationModel& model, const TerrainSettings& settings,
                                   const TerrainOutputs& outputs, const RunOptions& run = {});

// A point of a line through a model: its height, and its row or column, counted in the direction of
// the sweep.
struct TerrainHullPoint {
  float height;
  std::int32_t row;
};

// What a band of a model hands to the next one: what later ground can see of the lines that cross
// the border between the two, some points a line; all points of the line where it looks out of a
// bowl. The caller keeps them, as in a file.
class TerrainHulls {
 public:
  virtual ~TerrainHulls() = default;
  // The calls that follow are of this sweep, counted from 0; sweeps come in rising order.
  virtual Status begin(int sweep) = 0;
  // A line that crosses the border, one in each column of the model at most. From several threads.
  virtual Status put(int column, std::span<const TerrainHullPoint> hull) = 0;
  // Replaces `hull` by what was put. From several threads.
  virtual Status get(int column, std::vector<TerrainHullPoint>* hull) = 0;
};

// Rows that a band needs around those where results are wanted, where the model has them.
inline constexpr int kTerrainBandHalo = 64;

// Radii of bands are infinite or less than so many cells, of the shorter side.
inline constexpr int kTerrainBandRadius = 25;

// Where a band lies in its model, and how it goes on.
struct TerrainBand {
  int height = 0;   // [1, 262144] rows of the whole model
  int row = 0;      // of the whole model, which is the band's first
  bool up = false;  // after all bands downwards, all of them upwards
  // What the band before has handed on; null: this is the first one.
  TerrainHulls* from = nullptr;
  // Takes what the next one needs; null: this is the last one.
  TerrainHulls* to = nullptr;
};

// Computes a model of which memory holds a band of whole rows only. Each band is computed twice:
// from the first one down, which leaves parts of results in the outputs, then from the last one up,
// which makes results of these. The bits are those of compute_terrain.
//
// Guarantees: on error the outputs are untouched, or parts of results if hulls cannot be kept.
// Requires: model.inner spans the width; heights have kTerrainBandHalo rows more above and below it
// or reach the whole model's border; row_widths, if any, has a number for each row of the whole
// model; datum is given, no surround. A radius of infinity, or less than kTerrainBandRadius
// cells.
OBSCURA_API Status compute_terrain_band(const ElevationModel& model, const TerrainBand& band,
                                        const TerrainSettings& settings,
                                        const TerrainOutputs& outputs, const RunOptions& run = {});

// Coarse heights of a model, for tiles of it to be surrounded by: of each block of factor x factor
// cells half way between their mean and the highest, which is closest to what they hide. A strip of
// a model, as high as a multiple of `factor`, gives its rows of the coarse model.
//
// Requires: `coarse` of ceil(width / factor) x ceil(height / factor) cells. Those without data
// become NaN.
OBSCURA_API Status coarsen_terrain(const ElevationModel& model, int factor,
                                   ImageView<float> coarse);

}  // namespace obscura

#endif  // OBSCURA_TERRAIN_H_
