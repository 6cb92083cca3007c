// In place of vdb.cpp where the build has no OpenVDB.
#include "fmt/format.h"
#include "io/volumes/vdb.h"

namespace obscura::tools {
namespace {

Status absent(const std::string& path) {
  return unsupported(
      fmt::format("{}: this build has no OpenVDB; build with OBSCURA_WITH_OPENVDB=ON", path));
}

}  // namespace

bool has_openvdb() { return false; }

Status read_vdb(const std::string& path, const std::string&, VolumeImage*) { return absent(path); }

Status write_vdb(const std::string& path, const FieldGrid&, std::span<const NamedField>) {
  return absent(path);
}

}  // namespace obscura::tools
