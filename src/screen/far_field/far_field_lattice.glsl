// What is interpolated between texels: 1/depth, or for parallel rays ortho_offset - depth;
// 0 on the background. Before this: buffer `ortho_offset`.
float lattice_value(float d) {
  if (!(d < kInf)) return 0.0;
  return view.orthographic != 0 ? ortho_offset[0] - d : 1.0 / d;
}
float depth_of(float g) { return view.orthographic != 0 ? ortho_offset[0] - g : 1.0 / g; }
const float kSmallest = 1e-30;
