// The obscurance of one azimuthal slice, piece by piece: math/slab-inl.h in GLSL, whose comments hold
// here. Before this: math/slab_leaf.h, rho_of(distance), kChord, and kSums (SliceSums).
const int kSumVisibility = 0, kSumUniform = 1, kSumCosine = 2;
const float kLeastRise = 5e-4, kHorizonSlack = 1e-5, kSmallPiece = 0.25, kTiny = 1e-30;

struct Slice {
  float nz, nt;
  float edge_sine, edge_cosine, edge_angle, edge_integral;
  float camera, perspective;
};

vec2 direction_integral(Slice s, float sine, float cosine, float angle) {
  if (kSums == kSumUniform) return vec2(uniform_along(sine, cosine, angle), uniform_zenith(sine));
  return vec2(weighted_along(s.nz, s.nt, sine, cosine), weighted_zenith(s.nz, s.nt, sine, cosine));
}

Slice make_slice(float nz, float nt, float camera, float perspective) {
  Slice s;
  s.nz = nz;
  s.nt = nt;
  s.camera = camera;
  s.perspective = perspective;
  const float inverse = 1.0 / sqrt(max(nz * nz + nt * nt, kTiny));
  s.edge_sine = abs(nz) * inverse;
  s.edge_cosine = (nz < 0.0 ? nt : -nt) * inverse;
  s.edge_angle = fast_acos(s.edge_cosine);
  s.edge_integral = cosine_integral(nz, nt, s.edge_sine, s.edge_cosine, s.edge_angle);
  return s;
}

struct Horizon {
  float cosine;
  float sine_c, cosine_c, angle_c;
  float integral;
  vec2 point;
  bool chord;
  vec2 directions;  // integrals at the clipped theta
  float sum, sum_solid;
  vec2 sum_directions;
};

Horizon start_horizon(Slice s, bool from_receiver) {
  const bool away = s.nz < 0.0;
  Horizon h;
  h.cosine = -2.0;
  h.sine_c = away ? 0.0 : s.edge_sine;
  h.cosine_c = away ? -1.0 : s.edge_cosine;
  h.angle_c = away ? 3.14159265 : s.edge_angle;
  h.integral = away ? s.nt * 1.57079633 : s.edge_integral;
  h.point = vec2(0.0);
  h.chord = from_receiver;
  h.directions = direction_integral(s, h.sine_c, h.cosine_c, h.angle_c);
  h.sum = 0.0;
  h.sum_solid = 0.0;
  h.sum_directions = vec2(0.0);
  return h;
}

float cross_product(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }

// A Gauss node at direction w: its weight, and with that times rho.
vec2 gauss_node(Slice s, vec2 w, float gauss, vec2 e, float numerator) {
  const float distance = min(numerator / max(abs(cross_product(w, e)), kTiny), 1e30);
  const float weight = max(w.x * (s.nz * w.y + s.nt * w.x), 1e-12) * gauss;
  return vec2(weight, weight * rho_of(distance));
}

// rho averaged over the piece between the horizon and the direction (sine, cosine) of point p.
float mean_rho(Slice s, Horizon h, vec2 p, float sine, float cosine, float angle) {
  vec2 at = p, e = p * s.perspective - vec2(0.0, s.camera);
  if (kChord && h.chord) {
    const vec2 step = p - h.point;
    if (step.x > 0.0 && step.y > step.x) {
      at.x -= 0.5 * step.x;
      e.x = at.x * s.perspective;
    } else {
      e = step;
    }
  }
  const float numerator = abs(cross_product(at, e));
  const vec2 sum = vec2(h.sine_c + sine, h.cosine_c + cosine);
  const vec2 m = sum * inversesqrt(max(dot(sum, sum), kTiny));
  const float half_piece = 0.5 * (h.angle_c - angle);
  vec2 total = gauss_node(s, m, 8.0 / 9.0, e, numerator);
  if (half_piece >= kSmallPiece) {
    const float t = half_piece * 0.774596669;
    const vec2 turn = vec2(sin(t), cos(t));
    total += gauss_node(s, vec2(m.x * turn.y + m.y * turn.x, m.y * turn.y - m.x * turn.x),
                        5.0 / 9.0, e, numerator);
    total += gauss_node(s, vec2(m.x * turn.y - m.y * turn.x, m.y * turn.y + m.x * turn.x),
                        5.0 / 9.0, e, numerator);
  }
  return total.y / total.x;
}

// A direction clipped to the hemisphere.
struct Edge {
  float sine, cosine, angle, integral;
};
Edge clip_to_hemisphere(Slice s, float sine, float cosine, float angle) {
  if ((s.nz < 0.0) != (cosine <= s.edge_cosine)) {
    return Edge(s.edge_sine, s.edge_cosine, s.edge_angle, s.edge_integral);
  }
  return Edge(sine, cosine, angle, cosine_integral(s.nz, s.nt, sine, cosine, angle));
}

// Adds the next point outwards, one that stands in a share of the slice's width.
void add_part(Slice s, vec2 p, bool valid, float share, inout Horizon h) {
  const float inverse = inversesqrt(max(dot(p, p), kTiny));
  const float cosine = p.y * inverse;
  const bool visible = valid && cosine > h.cosine;
  float horizon = cosine;
  if (visible && (share < 1.0 || cosine > h.cosine_c + kLeastRise)) {
    const float c = min(cosine, 1.0), angle = fast_acos(c);
    Edge edge = clip_to_hemisphere(s, p.x * inverse, c, angle);
    const float weight = h.integral - edge.integral;
    if (weight > 0.0) {
      const float mean = share * mean_rho(s, h, p, edge.sine, edge.cosine, edge.angle);
      h.sum += weight * mean;
      if (kSums != kSumVisibility) {
        h.sum_directions +=
            (h.directions - direction_integral(s, edge.sine, edge.cosine, edge.angle)) * mean;
      }
      if (kSums == kSumUniform) h.sum_solid += (edge.cosine - h.cosine_c) * mean;
    }
    if (share < 1.0) {
      // The horizon of the slice as a whole: the mean angle of its covered and its open part.
      const float before = fast_acos(max(h.cosine + kHorizonSlack, -1.0));
      const float between = mix(before, angle, share);
      horizon = cos(between);
      edge = clip_to_hemisphere(s, sin(between), horizon, between);
    }
    h.sine_c = edge.sine;
    h.cosine_c = edge.cosine;
    h.angle_c = edge.angle;
    h.integral = edge.integral;
    if (kSums != kSumVisibility) {
      h.directions = direction_integral(s, edge.sine, edge.cosine, edge.angle);
    }
  }
  if (visible) h.cosine = horizon - kHorizonSlack;
  h.point = p;
  h.chord = visible;
}

// The same over the slice's whole width.
void add_point(Slice s, vec2 p, bool valid, inout Horizon h) { add_part(s, p, valid, 1.0, h); }
