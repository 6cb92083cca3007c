#ifndef OBSCURA_SCENE_VOLUMES_FIELD_BLOCKS_H_
#define OBSCURA_SCENE_VOLUMES_FIELD_BLOCKS_H_

#include <string>
#include <vector>

#include "io/volumes/nrrd.h"
#include "io/volumes/volume_image.h"
#include "obscura/volume_blocks.h"

namespace obscura::tools {

// Fields of a volume that are written to a file.
enum class FieldsKind { kOctants, kScalar, kDistance };

std::vector<std::string> field_names(FieldsKind kind);
// Where the samples of a field lie in the world; `field` is not read for distances. A field of a
// block gives the block's planes.
FieldGrid field_grid(FieldsKind kind, const VolumeImage& image, const VisibilityField& field);

// Planes of a volume that one rank holds, or that are in memory at a time.
struct Slab {
  int begin = 0, end = 0;
  int planes() const { return end - begin; }
};
// All of `depth` planes in `count` slabs as equal as multiples of `cell` can be; fewer slabs where
// there are not enough planes.
std::vector<Slab> split_planes(int depth, int cell, int count);

// Samples of a slab with their neighbours above and below, from a file.
struct SlabSamples {
  VolumeImage image;
  bool below = false, above = false;

  Status read(const PlaneFile& file, const Slab& slab);
  // The slab's own planes.
  VolumeView own() const;
};

// Range of values seen so far. A slab may hold NaN only.
void add_to_range(const VolumeRange& slab, VolumeRange* all);
Status slab_range(const SlabSamples& samples, const RunOptions& run, VolumeRange* range);

// Values of a block as the file holds them: fields of a voxel beside each other.
Status field_values(FieldsKind kind, const VisibilityField& field, const RunOptions& run,
                    std::vector<float>* values);

}  // namespace obscura::tools

namespace obscura {
template <>
struct EnumNames<tools::FieldsKind> {
  static constexpr const char* names[] = {"octants", "scalar", "distance"};
};
}  // namespace obscura

#endif  // OBSCURA_SCENE_VOLUMES_FIELD_BLOCKS_H_
