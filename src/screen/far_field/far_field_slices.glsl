// Receivers of a row. After far_field.glsl and screen/far_field/slices_leaf.h.
struct Receiver {
  bool surface;
  float depth;
  ViewRay ray;
  vec3 normal;  // (u, v, w), w away from the camera
};

Receiver receiver_at(ivec2 at, float g, vec3 normal) {
  const vec2 axis = vec2(at + plane_corner()) - plane_center();
  Receiver r;
  r.surface = g > 0.0;
  r.depth = r.surface ? depth_of(g) : 1.0;
  const vec2 ray = view.orthographic != 0 ? vec2(0.0) : axis * plane_scale();
  r.ray = make_ray(ray.x, ray.y);
  // The image's v and the third axis run against eye space's y and z.
  r.normal = vec3(is_transposed() ? vec2(-normal.y, normal.x) : vec2(normal.x, -normal.y), -normal.z);
  return r;
}

// `slopes` are those of the segment's low edge, middle and high edge.
Part part_of(Receiver r, float sign_v, vec3 slopes) {
  const vec2 scale = plane_scale();
  const float v = sign_v * scale.y;
  return make_part(r.ray, r.depth, r.normal.x, r.normal.y, r.normal.z, slopes.y * scale.x, v,
                   slopes.x * scale.x, v, slopes.z * scale.x, v, view.orthographic != 0);
}

// One row outwards on the segment's middle line.
vec2 middle_of(float sign_v, vec3 slopes) {
  return vec2(slopes.y, sign_v) * plane_scale();
}

// Channels as in totals.h: obscurance, directions along u, v and the view ray, solid angle.
struct Totals {
  float obscurance, solid;
  vec3 directions;
};

void add_slice(Part part, vec2 middle, float sum, vec2 directions, float solid,
               inout Totals totals) {
  totals.obscurance += part.width * sum;
  if (kSums == kSumVisibility) return;
  const float tangent = share_of_middle(part, directions.x);
  totals.directions.xy += tangent * middle;
  totals.directions.z -= share_of_ray(part, directions.y, tangent);
  totals.solid += part.width * solid;
}

void store_totals(int at, int pixels, Totals totals) {
  if (view.add != 0) {
    totals.obscurance += sums[at];
    if (kSums != kSumVisibility) {
      for (int c = 0; c < 3; ++c) totals.directions[c] += sums[(1 + c) * pixels + at];
      totals.solid += sums[4 * pixels + at];
    }
  }
  sums[at] = totals.obscurance;
  if (kSums == kSumVisibility) return;
  for (int c = 0; c < 3; ++c) sums[(1 + c) * pixels + at] = totals.directions[c];
  sums[4 * pixels + at] = totals.solid;
}
