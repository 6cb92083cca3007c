#ifndef OBSCURA_SCENE_RAYS_INTERVALS_H_
#define OBSCURA_SCENE_RAYS_INTERVALS_H_

#include <vector>

#include "scene/rays/ray_scene.h"

namespace obscura::tools {

// Matter along a ray, in multiples of its direction.
struct Interval {
  double front = 0, back = 0;
};

// Turns all crossings of a ray into disjoint intervals of matter, nearest first. `hits` as from
// RayScene::intersect_all, in any order; they come back grouped by part. `sheet` is the extent of
// an open sheet.
//
// The ray is inside a closed part while entries outnumber exits. A ray through an edge may count
// twice or not at all; if entries and exits do not balance, the part ends at the first exit after
// an entry. A crossing without a partner counts as a sheet.
void find_matter(const RayScene& scene, Vec3 direction, double sheet,
                 std::vector<RayScene::Hit>* hits, std::vector<Interval>* matter);

}  // namespace obscura::tools

#endif  // OBSCURA_SCENE_RAYS_INTERVALS_H_
