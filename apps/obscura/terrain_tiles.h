#ifndef OBSCURA_APPS_OBSCURA_TERRAIN_TILES_H_
#define OBSCURA_APPS_OBSCURA_TERRAIN_TILES_H_

#include <string>

#include "apps/obscura/terrain_quantities.h"
#include "io/rasters/raster.h"
#include "obscura/terrain.h"

namespace obscura::app {

// A raster computed tile by tile. Tiles that are done lie in the folder OUTPUT.tiles until all are:
// a run that was ended goes on, and several runs may each compute their part.
struct TerrainTiles {
  std::string input, output;
  tools::RasterOptions read;
  TerrainSettings settings;  // radius and z_factor are the raster's
  TerrainQuantities quantities;
  std::string about;        // what makes tiles of one run: all settings, as text
  int side = 0;             // cells of a tile
  int part = 1, parts = 1;  // this run computes every parts-th tile
  int threads = 0;
  bool overviews = false, quiet = false;

  Status run();
};

// Cells around a tile that are computed with it, for a radius in metres.
int tile_halo(const tools::Raster& raster, double radius);
// Cells of a tile whose computation takes at most so many bytes, 0 where none does.
int tile_side(double bytes, int halo, int channels);
double tile_bytes(double side, int halo, int channels);
// What a raster takes that is computed as a whole.
double whole_bytes(const tools::Raster& raster, int channels);

}  // namespace obscura::app

#endif  // OBSCURA_APPS_OBSCURA_TERRAIN_TILES_H_
