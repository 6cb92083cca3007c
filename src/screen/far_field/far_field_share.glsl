// What neighbours' slices count for a pixel (share.cpp, share_simd.cpp). After math/leaf_glsl.h and
// screen/far_field/share_leaf.h, gpu/view.glsl, kSide, buffers `depth` and `normals`.

// Eye space with y down and z away from the camera.
SharePoint share_point(ivec2 p, float z) {
  const vec2 axis = vec2(p + ivec2(view.left, view.top)) + 0.5 - vec2(view.center_u, view.center_v);
  const vec2 at = axis * vec2(view.scale_x, view.scale_y) * (view.orthographic != 0 ? 1.0 : z);
  const vec3 n = normals[p.y * view.visible_width + p.x].xyz;
  return SharePoint(at.x, at.y, z, n.x, -n.y, -n.z);
}

// Of a visible pixel; beyond them there is no surface.
float share_depth(ivec2 p) {
  const bool inside = all(greaterThanEqual(p, ivec2(0))) && p.x < view.visible_width &&
                      p.y < view.visible_height;
  return inside ? depth[(p.y + view.top) * view.width + p.x + view.left] : kInf;
}

// Of the nine pixels around a surface, row by row.
float[9] share_weights(ivec2 p, float own_depth) {
  const SharePoint own = share_point(p, own_depth);
  const float inverse_footprint =
      1.0 / ((view.orthographic != 0 ? 1.0 : own_depth) * max(view.scale_x, view.scale_y));
  float weights[9];
  for (int i = 0; i < 9; ++i) {
    const ivec2 k = ivec2(i % 3, i / 3) - 1;
    const float z = share_depth(p + k);
    weights[i] = z < kInf ? weight_of_place(k.x, k.y, kSide) : 0.0;
    if (i != 4 && z < kInf) {
      weights[i] *= weight_of_surface(own, share_point(p + k, z), inverse_footprint);
    }
  }
  return weights;
}
