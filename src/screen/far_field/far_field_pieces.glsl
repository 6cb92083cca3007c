// Pieces of matter as memory holds them: of finite occluders two vec4 each. Before this:
// screen/far_field/scan_leaf.h, kFinite and
// row_length(), from row to row in outward coordinates.
struct Stored {
  vec4 first, rest;
};
Stored stored_matter(Matter m) {
  return Stored(vec4(m.first.nearest, m.first.slanted, m.first.deepest, m.first.end),
                vec4(m.rest.front, m.rest.back, m.rest.filled, m.first.begin));
}
Stored stored_piece(Piece p) { return stored_matter(Matter(p, no_rest())); }
Piece loaded_piece(Stored s) {
  return Piece(s.first.x, s.first.y, s.first.z, s.rest.w, s.first.w);
}
Rest loaded_rest(vec4 r) { return Rest(r.x, r.y, r.z); }
Matter loaded_matter(Stored s) { return Matter(loaded_piece(s), loaded_rest(s.rest)); }

// Of two strips, the first one nearer to the edge at which lines begin.
Stored merged(Stored a, Stored b) {
  if (kFinite) {
    return stored_matter(merged_matter(loaded_matter(a), loaded_matter(b),
                                       slack_of_pixels(view.scale_x, view.scale_y),
                                       row_length()));
  }
  return stored_piece(merged_strips(loaded_piece(a), loaded_piece(b)));
}
