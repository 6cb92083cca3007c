// The depth image in one of two orientations, as screen/far_field/plane.h has it. Before this:
// view.transposed, view.lattice_stride, view.margin, view.directions, buffer `quads` (tables).
#include "screen/far_field/far_field_lattice.glsl"

bool is_transposed() { return view.transposed != 0; }
// (u, v) of the plane from (x, y) of the image, and back.
ivec2 turned(ivec2 p) { return is_transposed() ? p.yx : p; }

ivec2 plane_size() { return turned(ivec2(view.width, view.height)); }
ivec2 plane_visible() { return turned(ivec2(view.visible_width, view.visible_height)); }
ivec2 plane_corner() { return turned(ivec2(view.left, view.top)); }
vec2 plane_scale() {
  const vec2 scale = vec2(view.scale_x, view.scale_y);
  return is_transposed() ? scale.yx : scale;
}
// Texel centres are whole numbers.
vec2 plane_center() {
  const vec2 center = vec2(view.center_u, view.center_v) - 0.5;
  return is_transposed() ? center.yx : center;
}

// A direction in the tables: four quads.
struct Direction {
  int sign_v, share, strip_offset, lines;
  int rows, headers, row_base;
  uvec4 strips, raw_rows;  // of levels 0 to 3
};
Direction direction_at(int i) {
  const uvec4 a = quads[view.directions + 4 * i], b = quads[view.directions + 4 * i + 1];
  Direction d;
  d.sign_v = int(a.x);
  d.share = int(a.y);
  d.strip_offset = int(a.z);
  d.lines = int(a.w);
  d.rows = int(b.x);
  d.headers = int(b.y);
  d.row_base = int(b.z);
  d.strips = quads[view.directions + 4 * i + 2];
  d.raw_rows = quads[view.directions + 4 * i + 3];
  return d;
}
