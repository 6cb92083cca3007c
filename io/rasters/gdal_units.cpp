// Metres from a raster's coordinate system.
#include <ogr_srs_api.h>

#include <cmath>
#include <numbers>

#include "fmt/format.h"
#include "io/rasters/gdal_session.h"

namespace obscura::tools {
namespace {

// Metres per degree of longitude and of latitude on an ellipsoid.
struct Degree {
  double east, north;
};
Degree degree_at(double latitude, double axis, double inverse_flattening) {
  const double radians = std::numbers::pi / 180, phi = latitude * radians;
  const double f = inverse_flattening > 0 ? 1 / inverse_flattening : 0, e2 = f * (2 - f);
  const double w = std::sqrt(1 - e2 * std::sin(phi) * std::sin(phi));
  return {axis / w * std::cos(phi) * radians, axis * (1 - e2) / (w * w * w) * radians};
}

Status geographic(const std::string& path, OGRSpatialReferenceH system, const Georeference& r,
                  Raster* raster) {
  const double unit = OSRGetAngularUnits(system, nullptr) * 180 / std::numbers::pi;  // degrees
  const double axis = OSRGetSemiMajor(system, nullptr);
  const double flattening = OSRGetInvFlattening(system, nullptr);
  const double north =
      r.south_up ? r.transform[3] + r.transform[5] * raster->height : r.transform[3];
  const double step = std::fabs(r.transform[5]) * unit;
  for (int y = 0; y < raster->height; ++y) {
    const double latitude = north * unit - (y + 0.5) * step;
    if (std::fabs(latitude) > 89.9) {
      return invalid_input(fmt::format(
          "{}: row {} lies at a latitude of {:.4g} degrees, where degrees of longitude have no "
          "width; project it first",
          path, y, latitude));
    }
    raster->row_widths.push_back(degree_at(latitude, axis, flattening).east * unit *
                                 std::fabs(r.transform[1]));
  }
  const double middle = north * unit - 0.5 * raster->height * step;
  raster->cell_width = raster->row_widths[raster->height / 2];
  raster->cell_height = degree_at(middle, axis, flattening).north * step;
  return {};
}

// Metres of the unit that a band names; 0 where it names none.
Status height_unit(const std::string& path, const std::string& unit, double* metres) {
  struct Unit {
    const char* name;
    double metres;
  };
  constexpr double kFoot = 0.3048, kSurveyFoot = 1200.0 / 3937;
  constexpr Unit units[] = {{"", 0},
                            {"m", 1},
                            {"metre", 1},
                            {"meter", 1},
                            {"metres", 1},
                            {"meters", 1},
                            {"cm", 0.01},
                            {"dm", 0.1},
                            {"km", 1000},
                            {"ft", kFoot},
                            {"foot", kFoot},
                            {"feet", kFoot},
                            {"sfoot", kSurveyFoot},
                            {"us-ft", kSurveyFoot},
                            {"ftUS", kSurveyFoot},
                            {"US survey foot", kSurveyFoot}};
  for (const Unit& u : units) {
    if (unit != u.name) continue;
    *metres = u.metres;
    return {};
  }
  return invalid_input(
      fmt::format("{}: its heights are in '{}', which is no unit known here; give --z-factor, "
                  "which makes metres of them",
                  path, unit));
}

}  // namespace

Status find_units(const std::string& path, GDALDatasetH dataset, GDALRasterBandH band,
                  const RasterOptions& options, const Georeference& reference, Raster* raster) {
  const OGRSpatialReferenceH system = GDALGetSpatialRef(dataset);
  double horizontal = 1;
  char* name = nullptr;
  if (system && OSRIsGeographic(system)) {
    if (!options.cell_size) {
      if (Status s = geographic(path, system, reference, raster); !s.ok()) return s;
    }
  } else {
    if (system) horizontal = OSRGetLinearUnits(system, &name);
    double transform[6];
    if (GDALGetGeoTransform(dataset, transform) == CE_None) {
      raster->cell_width = std::fabs(transform[1]) * horizontal;
      raster->cell_height = std::fabs(transform[5]) * horizontal;
    }
  }
  if (options.z_factor) return {};
  double vertical = 0;
  if (Status s = height_unit(path, GDALGetRasterUnitType(band), &vertical); !s.ok()) return s;
  if (vertical == 0 && horizontal != 1) {
    return invalid_input(fmt::format(
        "{}: its cells are measured in {} and it does not say in what its heights are; give "
        "--z-factor 1 for metres, 0.3048 for feet",
        path, name ? name : "another unit"));
  }
  if (vertical > 0) raster->z_factor = vertical;
  return {};
}

}  // namespace obscura::tools
