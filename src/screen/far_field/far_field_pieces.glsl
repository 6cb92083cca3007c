// What a line has met within a strip: nearest depth, greatest slanted height and, of finite
// occluders, the depth where the nearest connected piece of matter ends. Before this: kFinite.
vec3 no_piece() { return vec3(kInf, -kInf, 0.0); }

// Of two strips, the first one nearer to the edge at which lines begin (scan_simd.cpp, MergeMatter).
vec3 merged(vec3 a, vec3 b) {
  const vec3 both = vec3(min(a.x, b.x), max(a.y, b.y), max(a.z, b.z));
  if (!kFinite) return both;
  const vec3 front = b.x < a.x ? b : a;
  const float farther = max(a.x, b.x);
  const bool joined = farther < kInf && farther - min(a.z, b.z) <= join_slack() * front.x;
  return joined ? both : front;
}
