// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after screen/horizon/lines_leaf.h,
// math/sectors_leaf.h and view/taps_leaf.h. No include guard, for it is included once per SIMD
// target.

// The matter of samples belongs together if it touches or is at most this many footprints apart in
// depth per pixel between them: as view/widths_leaf.h joins texels.
const float kJoinedPerPixel = 6.0f;
LEAF(Real) slack_of_samples(Real footprint, Real between) {
  return real(kJoinedPerPixel) * footprint * between;
}

// Half the width along the tangent of the matter that a sample stands for, which lies `between`
// pixels behind the sample before and at `distance` (1 where rays are parallel): it is as wide as
// that, or as its texel.
LEAF(Real) reach_of_sample(LEAF_IN(ImageLine) line, Real between, Real distance) {
  return (real(0.5f) * leaf_max(between, real(1.0f))) * (line.per_pixel * distance);
}
// This matter, from `p` at `depth` to `back`.
LEAF(MatterBox)
line_box(LEAF_IN(Slice) s, LEAF_IN(LinePoint) p, Real reach, Real depth, Real back, bool parallel) {
  MatterBox box;
  box.x = p.x;
  box.y = p.y;
  box.reach = reach;
  box.first_row = real(0.0f);
  box.last_row = real(0.0f);
  box.depth = depth;
  box.back = back;
  end_box(s, leaf_max(p.x - box.reach, real(0.0f)), p.x + box.reach, parallel, box);
  return box;
}

// Obscured by what of a slice's sectors is covered.
LEAF(Obscured) finish_sectors(LEAF_IN(Sectors) m) {
  Obscured o;
  o.visibility = m.sum;
  o.solid = m.sum_solid;
  o.along = m.sum_x;
  o.zenith = m.sum_y;
  return o;
}
