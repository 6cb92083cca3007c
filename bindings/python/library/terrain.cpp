#include "obscura/terrain.h"

#include <pybind11/stl.h>

#include <map>

#include "library/arrays.h"
#include "library/module.h"
#include "library/run.h"
#include "library/settings.h"

namespace obscura::python {
namespace {

using NamedArrays = std::vector<std::pair<std::string, py::array>>;

const std::map<std::string, ImageView<float> TerrainOutputs::*>& quantities() {
  static const std::map<std::string, ImageView<float> TerrainOutputs::*> all = {
      {"svf", &TerrainOutputs::svf},
      {"svf_normal", &TerrainOutputs::svf_normal},
      {"svf_cosine", &TerrainOutputs::svf_cosine},
      {"openness", &TerrainOutputs::openness},
      {"negative_openness", &TerrainOutputs::negative_openness},
      {"visible_sky", &TerrainOutputs::visible_sky},
      {"asvf", &TerrainOutputs::asvf},
      {"local_dominance", &TerrainOutputs::local_dominance}};
  return all;
}

// Of a part of a larger model: that model's width and height, the column and row of the heights in
// it, and x, y, width and height of what is wanted of them.
using Tile = std::array<int, 8>;

// Arrays of the size wanted by the names of quantities; "horizon" is (azimuths, H, W).
void compute(const py::object& heights, double cell_width, double cell_height,
             std::optional<float> nodata, const GivenSettings& given, const NamedArrays& arrays,
             std::optional<double> datum, const std::optional<Tile>& tile, int threads,
             const py::object& progress) {
  ElevationModel model;
  model.heights = image("heights", heights);
  model.cell_width = cell_width;
  model.cell_height = cell_height;
  model.nodata = nodata;
  const auto settings = read_settings<TerrainSettings>("terrain", given);
  model.datum = datum;
  Extent size{model.heights.width, model.heights.height};
  if (tile) {
    const Tile& t = *tile;
    model.surround.width = t[0];
    model.surround.height = t[1];
    model.surround.column = t[2];
    model.surround.row = t[3];
    model.inner = {t[4], t[5], t[6], t[7]};
    size = {t[6], t[7]};
  }
  TerrainOutputs outputs;
  std::vector<ImageView<float>> bands;
  for (const auto& [name, array] : arrays) {
    const auto at = quantities().find(name);
    if (at != quantities().end()) {
      outputs.*(at->second) = image_out(name, array, size);
    } else if (name == "horizon") {
      for (py::ssize_t k = 0; k < array.shape(0); ++k) {
        bands.push_back(image_out(name, array[py::int_(k)].cast<py::array>(), size));
      }
    } else {
      std::string names = "horizon";
      for (const auto& [known, view] : quantities()) names += ", " + known;
      throw py::value_error("there is no quantity '" + name + "'; there are " + names);
    }
  }
  outputs.horizon = bands;
  run(threads, progress, [&](const RunOptions& options) {
    return compute_terrain(model, settings, outputs, options);
  });
}

}  // namespace

void add_terrain(py::module_& m) { m.def("terrain", &compute); }

}  // namespace obscura::python
