// Single texels fetched around a pixel, as taps-inl.h; symbols as there. After math/leaf_glsl.h,
// view/taps_leaf.h and gpu/view.glsl.
const float kMaxReach = 131072.0;

struct Receiver {
  ivec2 at;  // pixel of the whole image
  float z;
  float distance;     // z, or 1 where rays are parallel
  float perspective;  // 1, or 0 where rays are parallel
  vec2 reach;         // the radius in pixels
  vec2 ray;           // (a, b) of (a, b, -1)
  vec3 normal;        // bent to face the camera
  float facing;       // n.r
  vec2 plane;         // n.x, n.y times a pixel's size
};

// Of visible pixel p.
Receiver receiver_at(ivec2 p, float z) {
  Receiver r;
  r.at = p + ivec2(view.left, view.top);
  r.z = z;
  r.perspective = view.orthographic != 0 ? 0.0 : 1.0;
  r.distance = view.orthographic != 0 ? 1.0 : z;
  const vec2 scale = vec2(view.scale_x, view.scale_y);
  r.reach = min(view.radius / scale / r.distance, vec2(kMaxReach));
  r.ray = r.perspective * scale *
          vec2(float(r.at.x) - (view.center_u - 0.5), view.center_v - (float(r.at.y) + 0.5));
  r.normal = vec3(0.0);
  r.facing = 0.0;
  r.plane = vec2(0.0);
  return r;
}

void set_normal(inout Receiver r, vec3 n) {
  const float facing = n.x * r.ray.x + n.y * r.ray.y - n.z;
  r.normal = n - bend_to_camera(facing, r.ray.x, r.ray.y) * vec3(r.ray, -1.0);
  r.facing = min(facing, kEdgeOn);
  r.plane = r.normal.xy * vec2(view.scale_x, view.scale_y);
}

// The texel nearest to `offset` pixels from the receiver, y down, or the border's.
ivec2 find_texel(Receiver r, vec2 offset) {
  return clamp(r.at + ivec2(roundEven(offset)), ivec2(0), ivec2(view.width, view.height) - 1);
}

// q and slope of the tangent plane at the texel k pixels away.
vec2 plane_at(Receiver r, vec2 k) {
  const float q = r.plane.y * k.y - r.plane.x * k.x;
  return vec2(q, r.facing - r.perspective * q);
}

vec2 ray_at(Receiver r, vec2 k) {
  return r.ray + r.perspective * vec2(k.x * view.scale_x, -k.y * view.scale_y);
}

float thickness_at(Receiver r, vec2 k) {
  const vec2 ray = ray_at(r, k);
  return depth_of_thickness(view.thickness, ray.x, ray.y);
}
