#ifndef OBSCURA_APPS_OBSCURA_TERRAIN_BANDS_H_
#define OBSCURA_APPS_OBSCURA_TERRAIN_BANDS_H_

#include <string>

#include "apps/obscura/terrain_quantities.h"
#include "io/rasters/raster.h"
#include "obscura/terrain.h"

namespace obscura::app {

// A raster computed band by band, downwards and upwards, with the bits of the whole. Bands that are
// done and the hulls that they hand on lie in the folder OUTPUT.bands: a run that was ended goes
// on.
struct TerrainBands {
  std::string input, output;
  tools::RasterOptions read;
  TerrainSettings settings;  // radius and z_factor are the raster's
  TerrainQuantities quantities;
  std::string about;  // what makes bands of one run: all settings, as text
  int rows = 0;       // of a band
  int threads = 0;
  bool overviews = false, quiet = false;

  Status run();
};

// Finite radii must be below this, in metres.
double band_radius(const tools::Raster& raster);

inline constexpr int kLeastBandRows = 16;

// Rows of a band whose computation takes at most so many bytes, 0 where none does; bytes of a band
// of so many rows.
int band_rows(const tools::Raster& raster, double bytes, const TerrainQuantities& quantities,
              int azimuths, int threads);
double band_bytes(const tools::Raster& raster, int rows, const TerrainQuantities& quantities,
                  int azimuths, int threads);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_TERRAIN_BANDS_H_
