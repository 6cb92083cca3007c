// This file and scene/volumes/vdb_distance.cpp are all that includes OpenVDB, which takes long to
// compile.
#include "io/volumes/vdb_native.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <vector>

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

// A place without a leaf has one value, its tile's. What is not active is background, unless all
// values are wanted.
template <class Tree>
void read_voxels(const Tree& tree, const openvdb::CoordBBox& box, bool all, float* values) {
  const auto background = static_cast<float>(tree.background());
  for_each_leaf(box, [&](const openvdb::Coord& first, const openvdb::CoordBBox& part) {
    const auto* leaf = tree.probeConstLeaf(first);
    float tile = background;
    if (!leaf && (all || tree.isValueOn(first))) tile = static_cast<float>(tree.getValue(first));
    for_each_voxel(part, box, [&](const openvdb::Coord& at, std::int64_t i) {
      if (!leaf) {
        values[i] = tile;
      } else {
        values[i] =
            all || leaf->isValueOn(at) ? static_cast<float>(leaf->getValue(at)) : background;
      }
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

using Memory = std::function<void(double)>;

template <class Grid>
Status densify(const Grid& grid, const char* stored, const Memory& memory, VolumeImage* image) {
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
  const std::size_t bytes = std::size_t(image->voxels()) * sizeof(float);
  memory(static_cast<double>(bytes));
  image->samples.resize(bytes);
  const bool level_set = grid.getGridClass() == openvdb::GRID_LEVEL_SET;
  read_voxels(grid.constTree(), box, level_set, reinterpret_cast<float*>(image->samples.data()));
  if (level_set) {
    image->isovalue = 0.0f;
    image->solid = SolidSide::kBelow;
  }
  return {};
}

Status densify_any(const openvdb::GridBase::Ptr& grid, const Memory& memory, VolumeImage* image) {
  using openvdb::gridPtrCast;
  if (auto g = gridPtrCast<openvdb::FloatGrid>(grid)) return densify(*g, "f32", memory, image);
  if (auto g = gridPtrCast<openvdb::DoubleGrid>(grid)) return densify(*g, "f64", memory, image);
  if (auto g = gridPtrCast<openvdb::Int32Grid>(grid)) return densify(*g, "i32", memory, image);
  if (auto g = gridPtrCast<openvdb::Int64Grid>(grid)) return densify(*g, "i64", memory, image);
  if (auto g = gridPtrCast<openvdb::BoolGrid>(grid)) return densify(*g, "bool", memory, image);
  return invalid_input(fmt::format("{}: its grid \"{}\" is {}, which is no grid of numbers",
                                   image->name, grid->getName(), grid->type()));
}

bool is_scalar(const std::string& type) {
  return type == "float" || type == "double" || type == "int32" || type == "int64" ||
         type == "bool";
}

bool is_constant(const VolumeImage& image) {
  const auto* v = reinterpret_cast<const float*>(image.samples.data());
  return std::all_of(v, v + image.voxels(), [&](float x) { return x == v[0]; });
}

// Names of the scalar grids in the order in which they are tried, and a list of all.
std::vector<std::string> candidates(openvdb::io::File& file, std::string* all) {
  std::vector<std::string> names;
  for (auto name = file.beginName(); name != file.endName(); ++name) {
    const auto meta = file.readGridMetadata(name.gridName());
    *all += fmt::format("{}{} ({})", all->empty() ? "" : ", ", name.gridName(), meta->type());
    if (is_scalar(meta->valueType())) names.push_back(name.gridName());
  }
  std::stable_partition(names.begin(), names.end(),
                        [](const std::string& name) { return name == "density"; });
  return names;
}

Status read_file(const std::string& path, const std::string& wanted, const Memory& memory,
                 VolumeImage* image) {
  openvdb::io::File file(path);
  file.open(false);  // no delayed loading: a damaged file shall fail here
  std::string all;
  const std::vector<std::string> names = candidates(file, &all);
  if (!wanted.empty() && std::ranges::find(names, wanted) == names.end()) {
    return invalid_input(fmt::format("{}: has no grid of numbers \"{}\" (--grid); its grids are {}",
                                     path, wanted, all));
  }
  if (names.empty()) {
    return invalid_input(
        fmt::format("{}: has no scalar grid; its grids are {}", path, all.empty() ? "none" : all));
  }
  Status first;
  for (const std::string& name : wanted.empty() ? names : std::vector{wanted}) {
    VolumeImage result;
    result.name = path;
    result.format = "OpenVDB";
    const Status s = densify_any(file.readGrid(name), memory, &result);
    const bool fits = s.ok() && (names.size() == 1 || !wanted.empty() || !is_constant(result));
    if (!fits) {
      if (first.ok()) first = s.ok() ? Status(invalid_input(path + ": no grid has two values")) : s;
      continue;
    }
    if (names.size() > 1 && wanted.empty()) {
      result.notes.push_back(
          fmt::format("{}: of its grids {}, {} is read (--grid)", path, all, name));
    }
    *image = std::move(result);
    return {};
  }
  return first;
}

}  // namespace

bool has_openvdb() { return true; }

Status read_vdb_trusting(const std::string& path, const std::string& grid, const Memory& memory,
                         VolumeImage* image) {
  try {
    initialize();
    return read_file(path, grid, memory, image);
  } catch (const std::bad_alloc&) {
    return invalid_input(
        fmt::format("{}: damaged: OpenVDB wants more memory than its size explains", path));
  } catch (const std::exception& e) {
    return invalid_input(fmt::format("{}: cannot be read as OpenVDB: {:.200}", path, e.what()));
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
