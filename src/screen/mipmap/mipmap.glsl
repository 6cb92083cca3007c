// Levels of the depth pyramid; 0 is the depth image itself. Before this: view.levels, where the tables
// have each level's start in the pyramid, width and height, `quads`, `depth` and `pyramid`.
ivec2 level_size(int level) { return ivec2(quads[view.levels + level].yz); }

int texel_index(int level, ivec2 p) {
  const uvec4 at = quads[view.levels + level];
  return int(at.x) + p.y * int(at.y) + p.x;
}

// Depth, 0 on the background.
float texel_of(int level, ivec2 p) {
  if (level > 0) return pyramid[texel_index(level, p)];
  const float d = depth[p.y * view.width + p.x];
  return d < kInf ? d : 0.0;
}

#ifdef WRITES_PYRAMID
void store_texel(int level, ivec2 p, float value) { pyramid[texel_index(level, p)] = value; }
#endif
