// The lattice of the pass's view. Before this: screen/far_field/lattice_leaf.h.
float lattice_value(float d) { return lattice_of_depth(d, view.orthographic != 0); }
float depth_of(float g) { return depth_of_lattice(g, view.orthographic != 0); }
float join_slack() { return slack_of_pixels(view.scale_x, view.scale_y); }
