// Receivers of the pass's view. After view/receiver_leaf.h and gpu/view.glsl.

// Of visible pixel p.
ivec2 whole_image(ivec2 p) { return p + ivec2(view.left, view.top); }
TapReceiver receiver_at(ivec2 p, float z) {
  const TapView v =
      TapView(view.scale_x, view.scale_y, view.center_u, view.center_v, view.radius / view.scale_x,
              view.radius / view.scale_y, view.orthographic != 0);
  const ivec2 at = whole_image(p);
  return make_tap_receiver(v, float(at.x), float(at.y), z);
}

// The texel nearest to `offset` pixels from visible pixel p, y down, or the border's.
ivec2 find_texel(ivec2 p, vec2 offset) {
  return clamp(whole_image(p) + ivec2(roundEven(offset)), ivec2(0),
               ivec2(view.width, view.height) - 1);
}
