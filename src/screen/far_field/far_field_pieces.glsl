// Pieces of matter as memory holds them. Before this: screen/far_field/scan_leaf.h, kFinite.
vec3 stored_piece(Piece p) { return vec3(p.nearest, p.slanted, p.deepest); }
Piece loaded_piece(vec3 p) { return Piece(p.x, p.y, p.z); }

// Of two strips, the first one nearer to the edge at which lines begin.
vec3 merged(vec3 a, vec3 b) {
  const Piece p = loaded_piece(a), q = loaded_piece(b);
  if (kFinite) {
    return stored_piece(merged_matter(p, q, slack_of_pixels(view.scale_x, view.scale_y)));
  }
  return stored_piece(merged_strips(p, q));
}
