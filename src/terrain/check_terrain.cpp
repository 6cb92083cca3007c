#include "terrain/check_terrain.h"

#include <algorithm>

#include "core/text.h"
#include "terrain/sweep_kernel.h"

namespace obscura {
namespace {

constexpr int kMostAround = 1 << 20;  // of a surround, in cells of the model

Status check_side(const char* name, double side) {
  if (side >= 1e-4 && side <= 1e6) return {};
  return invalid_argument(text(name, " is ", side, "; it must be in [1e-4, 1e6]"));
}

Status check_size(const char* name, const ImageView<float>& view, const TerrainWindow& inner) {
  if (view.empty() || (view.width == inner.width && view.height == inner.height)) return {};
  return invalid_input(text(name, " is ", view.width, "x", view.height,
                            "; it must be as large as what is wanted of the model, ", inner.width,
                            "x", inner.height));
}

Status check_surround(const ElevationModel& model, const TerrainSettings& settings) {
  const TerrainSurround& s = model.surround;
  const auto& heights = model.heights;
  if (s.heights.empty() && s.width == 0 && s.height == 0) return {};
  if (!s.heights.empty()) {
    if (std::isfinite(settings.radius)) {
      return invalid_argument(
          "surround.heights need a radius of infinity; a halo as wide as the radius makes finite "
          "ones exact");
    }
    if (s.factor < 1 || s.factor > 65536) {
      return invalid_argument(text("surround.factor is ", s.factor, "; it must be in [1, 65536]"));
    }
    if (s.heights.width != (s.width + s.factor - 1) / s.factor ||
        s.heights.height != (s.height + s.factor - 1) / s.factor) {
      return invalid_argument(text("surround.heights are ", s.heights.width, "x", s.heights.height,
                                   "; ", s.width, "x", s.height, " cells by a factor of ", s.factor,
                                   " need another size"));
    }
  }
  if (s.column < 0 || s.row < 0 || s.column + heights.width > s.width ||
      s.row + heights.height > s.height || s.width > kMostAround || s.height > kMostAround) {
    return invalid_argument(text("surround is ", s.width, "x", s.height,
                                 " cells and the model lies at ", s.column, ",", s.row,
                                 "; it must lie within, and sides be at most ", kMostAround));
  }
  return {};
}

Status check_tile(const ElevationModel& model, const TerrainSettings& settings) {
  const TerrainWindow inner = inner_of(model);
  const auto& heights = model.heights;
  if (inner.x < 0 || inner.y < 0 || inner.width < 1 || inner.height < 1 ||
      inner.width > heights.width - inner.x || inner.height > heights.height - inner.y) {
    return invalid_argument(text("inner is ", inner.width, "x", inner.height, " at ", inner.x, ",",
                                 inner.y, "; it must lie in the model, ", heights.width, "x",
                                 heights.height));
  }
  return check_surround(model, settings);
}

}  // namespace

Status check_terrain(const ElevationModel& model, const TerrainSettings& settings,
                     const TerrainOutputs& outputs, std::optional<int> rows) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (settings.dominance_to < settings.dominance_from) {
    return invalid_argument(text("dominance_to is ", settings.dominance_to,
                                 "; it must not be below dominance_from, ",
                                 settings.dominance_from));
  }
  const auto& heights = model.heights;
  if (heights.empty()) return invalid_input("heights are missing");
  if (heights.width < 1 || heights.height < 1 || heights.width > kMostTerrainCells ||
      heights.height > kMostTerrainCells) {
    return invalid_input(text("heights are ", heights.width, "x", heights.height,
                              " cells; a side must be in [1, ", kMostTerrainCells, "]"));
  }
  if (Status s = check_side("cell_width", model.cell_width); !s.ok()) return s;
  if (Status s = check_side("cell_height", model.cell_height); !s.ok()) return s;
  const auto has_widths = [&](std::int64_t count) {
    return static_cast<std::int64_t>(model.row_widths.size()) == count;
  };
  if (!model.row_widths.empty() && !has_widths(rows.value_or(heights.height)) &&
      !has_widths(rows ? *rows : model.surround.height)) {
    return invalid_input(text("row_widths has ", model.row_widths.size(),
                              " numbers; it must have one per row, ",
                              rows.value_or(heights.height)));
  }
  double cell = std::max(model.cell_width, model.cell_height);
  for (const double width : model.row_widths) {
    if (Status s = check_side("row_widths", width); !s.ok()) return s;
    cell = std::max(cell, width);
  }
  if (settings.radius < cell) {
    return invalid_argument(text("radius is ", settings.radius,
                                 "; it must reach the next cell, so be at least ", cell));
  }
  if (model.datum && !(std::fabs(*model.datum) <= kMostTerrainHeight)) {
    return invalid_argument(text("datum is ", *model.datum, "; it must be in [-1e9, 1e9]"));
  }
  if (Status s = check_tile(model, settings); !s.ok()) return s;
  const TerrainWindow inner = inner_of(model);
  struct Named {
    const char* name;
    const ImageView<float>& view;
  };
  const Named views[] = {{"svf", outputs.svf},
                         {"svf_normal", outputs.svf_normal},
                         {"svf_cosine", outputs.svf_cosine},
                         {"openness", outputs.openness},
                         {"negative_openness", outputs.negative_openness},
                         {"visible_sky", outputs.visible_sky},
                         {"asvf", outputs.asvf},
                         {"local_dominance", outputs.local_dominance}};
  bool any = !outputs.horizon.empty();
  for (const Named& v : views) {
    any = any || !v.view.empty();
    if (Status s = check_size(v.name, v.view, inner); !s.ok()) return s;
  }
  if (!any) return invalid_argument("outputs are all empty; give at least one");
  if (outputs.horizon.empty()) return {};
  if (outputs.horizon.size() != static_cast<std::size_t>(settings.azimuths)) {
    return invalid_argument(text("horizon has ", outputs.horizon.size(),
                                 " images; it must have one per azimuth, ", settings.azimuths));
  }
  for (const ImageView<float>& view : outputs.horizon) {
    if (view.empty()) return invalid_input("horizon has an image without data");
    if (Status s = check_size("horizon", view, inner); !s.ok()) return s;
  }
  return {};
}

Status check_terrain_band(const ElevationModel& model, const TerrainBand& band,
                          const TerrainSettings& settings, const TerrainOutputs& outputs) {
  const TerrainWindow inner = inner_of(model);
  if (inner.width != model.heights.width) {
    return invalid_argument(text("inner is ", inner.width, " cells wide; a band's is as wide as ",
                                 "the model, ", model.heights.width));
  }
  if (band.height < 1 || band.height > kMostTerrainCells) {
    return invalid_input(
        text("band.height is ", band.height, "; it must be in [1, ", kMostTerrainCells, "]"));
  }
  if (Status s = check_terrain(model, settings, outputs, band.height); !s.ok()) return s;
  const int rows = model.heights.height;
  if (band.row < 0 || rows > band.height - band.row) {
    return invalid_argument(text("band.row is ", band.row, "; its ", rows,
                                 " rows must lie in the model's ", band.height));
  }
  const int end = inner.y + inner.height;
  if (inner.y < std::min(kTerrainBandHalo, band.row + inner.y) ||
      rows - end < std::min(kTerrainBandHalo, band.height - band.row - end)) {
    return invalid_argument(text("inner has ", inner.y, " rows above it and ", rows - end,
                                 " below; a band needs ", kTerrainBandHalo,
                                 " or those up to the model's border"));
  }
  if (!model.surround.heights.empty()) {
    return invalid_argument("surround is given; bands need none, their results are exact");
  }
  if (!model.datum) return invalid_argument("datum is missing; all bands need the same");
  static_assert(kTerrainBandRadius == kMostMarched + 1);
  double cell = std::min(model.cell_width, model.cell_height);
  for (const double width : model.row_widths) cell = std::min(cell, width);
  if (std::isfinite(settings.radius) && settings.radius >= cell * kTerrainBandRadius) {
    return unsupported(text("radius is ", settings.radius, "; bands need infinity, or less than ",
                            cell * kTerrainBandRadius));
  }
  const bool first = band.up ? band.row + end == band.height : band.row + inner.y == 0;
  const bool last = band.up ? band.row + inner.y == 0 : band.row + end == band.height;
  if (std::isinf(settings.radius) && ((!first && !band.from) || (!last && !band.to))) {
    return invalid_argument(
        "band.from or band.to is missing; only the first and the last band do "
        "without");
  }
  return {};
}

double first_height(const ElevationModel& model) {
  for (int y = 0; y < model.heights.height; ++y) {
    for (int x = 0; x < model.heights.width; ++x) {
      const float height = model.heights(x, y);
      if (has_height(model, height)) return height;
    }
  }
  return 0;
}

}  // namespace obscura
