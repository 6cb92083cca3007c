// This file and vdb_distance.cpp are all that includes OpenVDB, which takes long to compile.
#include "io/volumes/vdb.h"

#include <fmt/format.h>

#include "io/images/atomic_file.h"

#ifdef OBSCURA_WITH_OPENVDB
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#endif

namespace obscura::tools {

#ifdef OBSCURA_WITH_OPENVDB
namespace {

// openvdb::initialize is not cheap and wants to be called once.
void initialize() {
  static const bool done = (openvdb::initialize(), true);
  (void)done;
}

Status place(const openvdb::GridBase& grid, const openvdb::Coord& first, VolumeImage* image) {
  if (!grid.transform().isLinear()) {
    return invalid_input(
        fmt::format("{}: its transform is not affine; resample the grid", image->name));
  }
  // OpenVDB's matrices act on row vectors.
  const auto m = grid.transform().baseMap()->getAffineMap()->getMat4();
  const auto origin = grid.transform().indexToWorld(first);
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) image->axes[a][k] = m[a][k];
    image->origin[a] = origin[a];
  }
  image->up = {0, 1, 0};
  return {};
}

template <class Grid>
Status densify(const Grid& grid, const char* stored, bool serial, VolumeImage* image) {
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  if (box.empty()) {
    return invalid_input(
        fmt::format("{}: its grid \"{}\" has no active voxel", image->name, grid.getName()));
  }
  for (int a = 0; a < 3; ++a) {
    const std::int64_t side = std::int64_t{box.max()[a]} - box.min()[a] + 1;
    image->size[a] = int(std::min<std::int64_t>(side, 1 << 30));
  }
  if (Status s = place(grid, box.min(), image); !s.ok()) return s;
  if (Status s = check_geometry(*image); !s.ok()) return s;
  constexpr std::int64_t kMostVoxels = std::int64_t{1} << 32;
  if (image->voxels() > kMostVoxels) {
    return invalid_input(fmt::format(
        "{}: its active voxels span {}x{}x{}; dense samples of more than 2^32 voxels are too many",
        image->name, image->size[0], image->size[1], image->size[2]));
  }
  image->type = VoxelType::kF32;
  image->stored_type = stored;
  image->samples.resize(std::size_t(image->voxels()) * sizeof(float));
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(
      box, reinterpret_cast<float*>(image->samples.data()));
  openvdb::tools::copyToDense(grid, dense, serial);
  if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
    image->isovalue = 0.0f;
    image->solid = SolidSide::kBelow;
  }
  return {};
}

Status densify_any(const openvdb::GridBase::Ptr& grid, bool serial, VolumeImage* image) {
  if (auto g = openvdb::gridPtrCast<openvdb::FloatGrid>(grid))
    return densify(*g, "f32", serial, image);
  if (auto g = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid))
    return densify(*g, "f64", serial, image);
  if (auto g = openvdb::gridPtrCast<openvdb::Int32Grid>(grid))
    return densify(*g, "i32", serial, image);
  if (auto g = openvdb::gridPtrCast<openvdb::Int64Grid>(grid))
    return densify(*g, "i64", serial, image);
  if (auto g = openvdb::gridPtrCast<openvdb::BoolGrid>(grid))
    return densify(*g, "bool", serial, image);
  return unsupported("");
}

}  // namespace

bool has_openvdb() { return true; }

Status read_vdb(const std::string& path, VolumeImage* image, bool serial) {
  if (Status s = check_readable(path); !s.ok()) return s;
  VolumeImage result;
  result.name = path;
  result.format = "OpenVDB";
  try {
    initialize();
    openvdb::io::File file(path);
    file.open(false);  // no delayed loading: a damaged file shall fail here
    std::string names;
    for (auto name = file.beginName(); name != file.endName(); ++name) {
      const auto meta = file.readGridMetadata(name.gridName());
      names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", name.gridName(), meta->type());
      if (meta->valueType() != "float" && meta->valueType() != "double" &&
          meta->valueType() != "int32" && meta->valueType() != "int64" &&
          meta->valueType() != "bool") {
        continue;
      }
      const Status s = densify_any(file.readGrid(name.gridName()), serial, &result);
      if (s.code() == StatusCode::kUnsupported) continue;
      if (s.ok()) *image = std::move(result);
      return s;
    }
    return invalid_input(fmt::format("{}: has no scalar grid; its grids are {}", path,
                                     names.empty() ? "none" : names));
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, fmt::format("{}: does not fit in memory", path)};
  } catch (const std::exception& e) {
    return invalid_input(fmt::format("{}: cannot be read as OpenVDB: {}", path, e.what()));
  }
}

Status write_vdb(const std::string& path, const FieldGrid& grid,
                 std::span<const NamedField> fields) {
  initialize();
  openvdb::math::Mat4d m = openvdb::math::Mat4d::identity();
  for (int a = 0; a < 3; ++a) {
    for (int k = 0; k < 3; ++k) m[a][k] = grid.axes[a][k];
    m[3][a] = grid.origin[a];
  }
  openvdb::GridPtrVec grids;
  const openvdb::CoordBBox box(
      openvdb::Coord(0), openvdb::Coord(grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1));
  for (const NamedField& field : fields) {
    auto g = openvdb::FloatGrid::create();
    g->setName(field.name);
    g->setTransform(openvdb::math::Transform::createLinearTransform(m));
    // Every voxel of the box counts, those equal to the background too.
    g->denseFill(box, 0.0f, true);
    auto voxels = g->getAccessor();
    const float* value = field.values.data();
    openvdb::Coord at;
    for (at.z() = 0; at.z() < grid.size[2]; ++at.z()) {
      for (at.y() = 0; at.y() < grid.size[1]; ++at.y()) {
        for (at.x() = 0; at.x() < grid.size[0]; ++at.x()) voxels.setValueOn(at, *value++);
      }
    }
    grids.push_back(g);
  }
  return write_atomically(path, [&](const std::string& temporary) -> Status {
    openvdb::io::File file(temporary);
    file.write(grids);
    file.close();
    return {};
  });
}

#else

bool has_openvdb() { return false; }

Status read_vdb(const std::string& path, VolumeImage*, bool) {
  return unsupported(
      fmt::format("{}: this build has no OpenVDB; build with OBSCURA_WITH_OPENVDB=ON", path));
}

Status write_vdb(const std::string& path, const FieldGrid&, std::span<const NamedField>) {
  return unsupported(
      fmt::format("{}: this build has no OpenVDB; build with OBSCURA_WITH_OPENVDB=ON", path));
}

#endif

}  // namespace obscura::tools
