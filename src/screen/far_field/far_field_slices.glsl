// Receivers of a row and their slices (receivers-inl.h). After far_field.glsl and azimuth_leaf.h.
struct Receiver {
  bool surface;
  float depth;
  vec3 ray, normal;  // (u, v, w), w away from the camera
  float ray_length;
};

Receiver receiver_at(ivec2 at, float g, vec3 normal) {
  const vec2 axis = vec2(at + plane_corner()) - plane_center();
  Receiver r;
  r.surface = g > 0.0;
  r.depth = r.surface ? depth_of(g) : 1.0;
  r.ray = vec3(view.orthographic != 0 ? vec2(0.0) : axis * plane_scale(), 1.0);
  r.ray_length = sqrt(dot(r.ray, r.ray));
  // The image's v and the third axis run against eye space's y and z.
  r.normal = vec3(is_transposed() ? vec2(-normal.y, normal.x) : vec2(normal.x, -normal.y), -normal.z);
  return r;
}

// The slice of one segment: a point `rows` outwards on its middle line lies at
// (depth' - depth) ray + rows * middle.
struct Part {
  Slice slice;
  vec2 middle;
  float along, across;  // its parts along and across the ray
  float width;          // w_k
};

Part make_part(Receiver r, float sign_v, vec3 slopes) {
  const vec2 scale = plane_scale();
  const float inverse = 1.0 / r.ray_length, v = sign_v * scale.y;
  const float low = slopes.x * scale.x, high = slopes.z * scale.x;
  Part part;
  part.middle = vec2(slopes.y * scale.x, v);
  part.along = part_along_ray(r.ray.x, r.ray.y, inverse, part.middle.x, v);
  part.across = part_across_ray(part.along, dot(part.middle, part.middle));
  const float nz = -dot(r.normal, r.ray) * inverse;
  const float nt = (dot(r.normal.xy, part.middle) + nz * part.along) / part.across;
  const float camera = view.orthographic != 0 ? 1.0 : r.depth * r.ray_length;
  part.slice = make_slice(nz, nt, camera, view.orthographic != 0 ? 0.0 : 1.0);
  part.width = angle_around_ray(inverse, part_along_ray(r.ray.x, r.ray.y, inverse, low, v),
                                part_along_ray(r.ray.x, r.ray.y, inverse, high, v),
                                abs(low * v - v * high), low * high + v * v);
  return part;
}

// In the slice's frame. `rows` is times depth unless view rays are parallel.
vec2 point_in(Receiver r, Part part, float depth, float rows) {
  return vec2(abs(rows * part.across), r.ray_length * (r.depth - depth) - rows * part.along);
}

// Channels as in totals.h: obscurance, directions along u, v and the view ray, solid angle.
struct Totals {
  float obscurance, solid;
  vec3 directions;
};

void add_slice(Part part, float sum, vec2 directions, float solid, inout Totals totals) {
  totals.obscurance += part.width * sum;
  if (kSums == kSumVisibility) return;
  const float tangent = part.width * directions.x / part.across;
  totals.directions.xy += tangent * part.middle;
  totals.directions.z -= part.width * directions.y + tangent * part.along;
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
