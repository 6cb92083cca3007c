// This file and scene/volumes/vdb_distance.cpp are all that includes OpenVDB, which takes long to
// compile.
#include "io/volumes/vdb.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>

#include "io/images/atomic_file.h"

namespace obscura::tools {
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

constexpr int kLeafSide = 8;

// Calls visit(leaf's first voxel, part of the leaf within the box) for every leaf that meets the
// box.
template <class Visit>
void for_each_leaf(const openvdb::CoordBBox& box, Visit&& visit) {
  openvdb::Coord at;
  for (at[2] = box.min()[2] & -kLeafSide; at[2] <= box.max()[2]; at[2] += kLeafSide) {
    for (at[1] = box.min()[1] & -kLeafSide; at[1] <= box.max()[1]; at[1] += kLeafSide) {
      for (at[0] = box.min()[0] & -kLeafSide; at[0] <= box.max()[0]; at[0] += kLeafSide) {
        openvdb::CoordBBox part = openvdb::CoordBBox::createCube(at, kLeafSide);
        part.intersect(box);
        visit(at, part);
      }
    }
  }
}

// Calls visit(voxel, its index in the box, x fastest) for a part of a box.
template <class Visit>
void for_each_voxel(const openvdb::CoordBBox& part, const openvdb::CoordBBox& box, Visit&& visit) {
  const openvdb::Coord size = box.dim();
  openvdb::Coord at;
  for (at[2] = part.min()[2]; at[2] <= part.max()[2]; ++at[2]) {
    for (at[1] = part.min()[1]; at[1] <= part.max()[1]; ++at[1]) {
      at[0] = part.min()[0];
      const openvdb::Coord from = at - box.min();
      std::int64_t index = (std::int64_t{from[2]} * size[1] + from[1]) * size[0] + from[0];
      for (; at[0] <= part.max()[0]; ++at[0]) visit(at, index++);
    }
  }
}

// A place without a leaf has one value, its tile's.
template <class Tree>
void read_voxels(const Tree& tree, const openvdb::CoordBBox& box, float* values) {
  for_each_leaf(box, [&](const openvdb::Coord& first, const openvdb::CoordBBox& part) {
    const auto* leaf = tree.probeConstLeaf(first);
    const float tile = leaf ? 0.0f : static_cast<float>(tree.getValue(first));
    for_each_voxel(part, box, [&](const openvdb::Coord& at, std::int64_t i) {
      values[i] = leaf ? static_cast<float>(leaf->getValue(at)) : tile;
    });
  });
}

void fill_voxels(const float* values, const openvdb::CoordBBox& box, openvdb::FloatTree* tree) {
  for_each_leaf(box, [&](const openvdb::Coord& first, const openvdb::CoordBBox& part) {
    auto* leaf = tree->touchLeaf(first);
    for_each_voxel(part, box, [&](const openvdb::Coord& at, std::int64_t i) {
      leaf->setValueOn(at, values[i]);
    });
  });
}

template <class Grid>
Status densify(const Grid& grid, const char* stored, VolumeImage* image) {
  // The virtual functions of the bases and the factory below keep the trees' templates in OpenVDB's
  // own library: compiled here they would take half a minute.
  openvdb::CoordBBox box;
  grid.constBaseTree().evalActiveVoxelBoundingBox(box);
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
  read_voxels(grid.constTree(), box, reinterpret_cast<float*>(image->samples.data()));
  if (grid.getGridClass() == openvdb::GRID_LEVEL_SET) {
    image->isovalue = 0.0f;
    image->solid = SolidSide::kBelow;
  }
  return {};
}

Status densify_any(const openvdb::GridBase::Ptr& grid, VolumeImage* image) {
  if (auto g = openvdb::gridPtrCast<openvdb::FloatGrid>(grid)) return densify(*g, "f32", image);
  if (auto g = openvdb::gridPtrCast<openvdb::DoubleGrid>(grid)) return densify(*g, "f64", image);
  if (auto g = openvdb::gridPtrCast<openvdb::Int32Grid>(grid)) return densify(*g, "i32", image);
  if (auto g = openvdb::gridPtrCast<openvdb::Int64Grid>(grid)) return densify(*g, "i64", image);
  if (auto g = openvdb::gridPtrCast<openvdb::BoolGrid>(grid)) return densify(*g, "bool", image);
  return unsupported("");
}

}  // namespace

bool has_openvdb() { return true; }

Status read_vdb(const std::string& path, VolumeImage* image) {
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
      const Status s = densify_any(file.readGrid(name.gridName()), &result);
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
    auto g = openvdb::gridPtrCast<openvdb::FloatGrid>(
        openvdb::GridBase::createGrid(openvdb::FloatGrid::gridType()));
    g->setName(field.name);
    g->setTransform(openvdb::math::Transform::createLinearTransform(m));
    fill_voxels(field.values.data(), box, &g->tree());
    grids.push_back(g);
  }
  return write_atomically(path, [&](const std::string& temporary) -> Status {
    openvdb::io::File file(temporary);
    file.write(grids);
    file.close();
    return {};
  });
}

}  // namespace obscura::tools
