#include "io/rasters/gdal_session.h"

#include <cpl_conv.h>
#include <cpl_error.h>

#include <algorithm>
#include <string_view>

namespace obscura::tools {
namespace {

// Drivers that read files on disk; those of web services are not among them.
constexpr std::string_view kLocalDrivers[] = {
    "VRT",   "GTiff",    "COG",    "AAIGrid", "GRASSASCIIGrid", "HFA",  "AIG",
    "EHdr",  "ENVI",     "ERS",    "SRTMHGT", "USGSDEM",        "DTED", "SDTS",
    "BT",    "GSAG",     "GSBG",   "GS7BG",   "SAGA",           "XYZ",  "RST",
    "ILWIS", "PCRaster", "netCDF", "HDF5",    "HDF5Image",      "GPKG", "JP2OpenJPEG",
    "MEM",   "PNG",      "ISIS3",  "PDS",     "PDS4",           "GMT",  "ZMap",
    "NTv2",  "SNODAS"};

void register_drivers() {
  GDALAllRegister();
  for (int i = GDALGetDriverCount() - 1; i >= 0; --i) {
    const GDALDriverH driver = GDALGetDriver(i);
    if (std::ranges::find(kLocalDrivers, std::string_view(GDALGetDriverShortName(driver))) ==
        std::end(kLocalDrivers)) {
      GDALDeregisterDriver(driver);
      GDALDestroyDriver(driver);
    }
  }
  // A VRT may hold a program.
  CPLSetConfigOption("GDAL_VRT_ENABLE_PYTHON", "NO");
}

}  // namespace

GdalSession::GdalSession(bool network) {
  static const bool registered = (register_drivers(), true);
  (void)registered;
  CPLSetThreadLocalConfigOption("CPL_VSIL_CURL_ALLOWED_FILENAME", network ? nullptr : "none");
  CPLPushErrorHandler(CPLQuietErrorHandler);
  CPLErrorReset();
}

GdalSession::~GdalSession() { CPLPopErrorHandler(); }

std::string GdalSession::message() {
  std::string text = CPLGetLastErrorMsg();
  std::ranges::replace(text, '\n', ' ');
  return text.empty() ? "no reason given" : text;
}

}  // namespace obscura::tools
