// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after screen/far_field/slices_leaf.h and
// math/sectors_leaf.h. No include guard, for it is included once per SIMD target.

// The box of a piece of matter from `depth` to `back`, from row `first` outwards to row `last`; a
// row reaches half a row to both sides. `rows` is where its front stands, times depth unless view
// rays are parallel.
LEAF(MatterBox)
matter_box(LEAF_IN(Part) p, Real rows, Real first, Real last, Real depth, Real back,
           bool parallel) {
  Real unit = parallel ? real(1.0f) : depth;
  MatterBox box;
  box.x = part_x(p, rows);
  box.y = part_y(p, depth, rows);
  box.reach = leaf_abs(real(0.5f) * (p.across * unit));
  box.first_row = first;
  box.last_row = last;
  box.depth = depth;
  box.back = back;
  Real before = leaf_max(part_x(p, first * unit) - box.reach, real(0.0f));
  Real behind = part_x(p, last * unit) + box.reach;
  end_box(p.slice, before, behind, parallel, box);
  return box;
}
