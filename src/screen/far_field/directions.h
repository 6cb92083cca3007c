#ifndef OBSCURA_SRC_SCREEN_FAR_FIELD_DIRECTIONS_H_
#define OBSCURA_SRC_SCREEN_FAR_FIELD_DIRECTIONS_H_

#include <vector>

#include "obscura/far_field.h"

namespace obscura::far_field {

// A direct sample of the near field, relative to the receiver's texel: between texels (du, dv),
// (du + 1, dv), (du, dv + 1) and (du + 1, dv + 1), dv counted outwards.
struct NearTap {
  float along;  // rows outwards
  int du, dv;
  float wu, wv;  // weights of the farther texels
};

// Part of a direction's sector. A slope is the change of u per row outwards.
struct Segment {
  float low = 0, high = 0, middle = 0;
  std::vector<NearTap> taps;  // in order of `along`, to the end of the longest near field
};

// One of the K scan directions: outwards along +v or -v (sign) of its plane.
struct Direction {
  bool transposed = false;
  int sign = 1;
  float slope = 0;
  int strip_offset = 0;  // rows by which the strips begin before the image
  int share = 0;         // of the directions that pixels of a group share out
  // One set of segments; where jittered, one per cell, each turned by its own angle.
  std::vector<std::vector<Segment>> segments;

  const std::vector<Segment>& segments_of(int cell) const {
    return segments.size() == 1 ? segments[0] : segments[cell];
  }
};

// Groups of n x n pixels share directions or jitter (3 x 3); a cell is a pixel's place in its
// group.
int group_side(const FarFieldSettings& settings);

// Rows from a receiver to its first interval lie in [interval, 2 interval).
inline int longest_near_field(int interval) { return 2 * interval - 1; }

std::vector<Direction> make_directions(const FarFieldSettings& settings);

// The farthest that any near tap or scanned interval reaches sideways, in texels.
int sideways_reach(const std::vector<Direction>& directions, int interval);

}  // namespace obscura::far_field

#endif  // OBSCURA_SRC_SCREEN_FAR_FIELD_DIRECTIONS_H_
