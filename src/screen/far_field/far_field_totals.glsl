// Sums of a pixel over all slices in scratch memory. Before this: far_field_outputs.glsl,
// buffer `totals`, and STORES_TOTALS where it may be written.
int pixels() { return view.visible_width * view.visible_height; }

Sums totals_at(int pixel) {
  Sums sums = Sums(totals[pixel], 0.0, vec3(0.0));
  if (kSums == 0) return sums;
  for (int c = 0; c < 3; ++c) sums.directions[c] = totals[(1 + c) * pixels() + pixel];
  sums.solid = totals[4 * pixels() + pixel];
  return sums;
}

void add_weighted(float weight, Sums other, inout Sums sums) {
  sums.obscurance += weight * other.obscurance;
  sums.directions += weight * other.directions;
  sums.solid += weight * other.solid;
}

#ifdef STORES_TOTALS
void store_totals(int pixel, Sums sums) {
  totals[pixel] = sums.obscurance;
  if (kSums == 0) return;
  for (int c = 0; c < 3; ++c) totals[(1 + c) * pixels() + pixel] = sums.directions[c];
  totals[4 * pixels() + pixel] = sums.solid;
}
#endif
