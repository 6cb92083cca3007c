#ifndef OBSCURA_SRC_VIEW_HALF_H_
#define OBSCURA_SRC_VIEW_HALF_H_

#include "obscura/camera.h"

namespace obscura::view {

// How many of `size` pixels are every second one, from the first on.
inline int half_of(int size) { return (size + 1) / 2; }

// The pixels of an image of half the size, along one axis: pixel first + 2 i of the whole image.
// The first visible pixel is among them.
struct HalfAxis {
  int first = 0, size = 0;
  int before = 0, visible = 0;  // pixels of the guard band before the visible part, and of that

  int after() const { return size - before - visible; }
};
inline HalfAxis halve(int size, int before, int visible) {
  HalfAxis a;
  a.first = before % 2;
  a.before = before / 2;
  a.size = half_of(size - a.first);
  a.visible = half_of(visible);
  return a;
}

// The camera whose pixel centres are those of every second pixel.
inline Camera halve(const Camera& camera, const HalfAxis& x, const HalfAxis& y) {
  Camera half = camera;
  half.scale_x = 2 * camera.scale_x;
  half.scale_y = 2 * camera.scale_y;
  half.center_u = 0.5f * (camera.center_u - static_cast<float>(x.first) + 0.5f);
  half.center_v = 0.5f * (camera.center_v - static_cast<float>(y.first) + 0.5f);
  return half;
}

}  // namespace obscura::view

#endif  // OBSCURA_SRC_VIEW_HALF_H_
