// The obscurance of one azimuthal slice whose matter has an end: math/matter-inl.h in GLSL, whose
// comments hold here. After math/slab.glsl.
struct SectorEdge {
  float sine, cosine, angle, place;
};

struct Sectors {
  uint covered;
  float first, span;
  vec2 point;
  float depth, back;
  SectorEdge last;
  bool joined;
  float sum, sum_solid;
  vec2 sum_directions;
  SectorEdge top;
};

SectorEdge find_sector(Slice s, Sectors m, vec2 p) {
  const float inverse = inversesqrt(max(dot(p, p), kTiny));
  const float c = clamp(p.y * inverse, -1.0, 1.0);
  const Edge edge = clip_to_hemisphere(s, p.x * inverse, c, fast_acos(c));
  return SectorEdge(edge.sine, edge.cosine, edge.angle,
                    32.0 * clamp((edge.integral - m.first) / m.span, 0.0, 1.0));
}

Sectors start_sectors(Slice s, bool from_receiver, float depth, float back) {
  const bool away = s.nz < 0.0;
  const float end = away ? s.nt * 1.57079633 : s.edge_integral;
  Sectors m;
  m.covered = 0u;
  m.first = away ? s.edge_integral : 0.0;
  m.span = max(end - m.first, 1e-12);
  m.point = vec2(0.0);
  m.depth = depth;
  m.back = back;
  m.last = away ? SectorEdge(0.0, -1.0, 3.14159265, 32.0)
                : SectorEdge(s.edge_sine, s.edge_cosine, s.edge_angle, 32.0);
  m.joined = from_receiver;
  m.sum = 0.0;
  m.sum_solid = 0.0;
  m.sum_directions = vec2(0.0);
  m.top = m.last;
  return m;
}

// Directions between two edges, per unit of the obscurance between them; z is solid angle.
vec3 directions_between(Slice s, SectorEdge low, SectorEdge high) {
  const vec2 sum = vec2(low.sine + high.sine, low.cosine + high.cosine);
  const vec2 m = sum * inversesqrt(max(dot(sum, sum), 1e-12));
  const float lobe = s.nz * m.y + s.nt * m.x;
  const float scale = kSums == kSumUniform ? 1.0 / max(lobe, 0.05) : 1.0;
  const float between = cosine_integral(s.nz, s.nt, high.sine, high.cosine, high.angle) -
                        cosine_integral(s.nz, s.nt, low.sine, low.cosine, low.angle);
  if (between < 1e-3) return scale * vec3(m, 1.0);
  const vec2 whole = direction_integral(s, high.sine, high.cosine, high.angle) -
                     direction_integral(s, low.sine, low.cosine, low.angle);
  return vec3(whole, low.cosine - high.cosine) / between;
}

// The sectors below a place on their scale.
uint sectors_below(float place) {
  const int n = clamp(int(roundEven(place)), 0, 32);
  return n == 32 ? 0xFFFFFFFFu : (1u << n) - 1u;
}

// rho at a share t of the chord between two directions.
float rho_between_edges(SectorEdge low, SectorEdge high, float t, vec2 e, float numerator) {
  const vec2 w = mix(vec2(low.sine, low.cosine), vec2(high.sine, high.cosine), t);
  const float scale = inversesqrt(max(dot(w, w), kTiny));
  return rho_of(min(numerator / max(scale * abs(cross_product(w, e)), kTiny), 1e30));
}

float mean_rho_of_matter(Slice s, Sectors m, vec2 p, bool joined, SectorEdge low,
                         SectorEdge high) {
  const vec2 step = p - m.point;
  vec2 at = p, e = p * s.perspective - vec2(0.0, s.camera);
  if (joined && step.x > 0.0 && step.y > step.x) {
    at.x -= 0.5 * step.x;
    e.x = at.x * s.perspective;
  } else if (joined) {
    e = step;
  }
  const float numerator = abs(cross_product(at, e));
  return 0.5 * (rho_between_edges(low, high, 0.25, e, numerator) +
                rho_between_edges(low, high, 0.75, e, numerator));
}

// Adds the next point outwards, one that is there: matter from p at `depth` to `end` at `back`.
void add_matter(Slice s, vec2 p, vec2 end, float depth, float back, float slack, float dither,
                inout Sectors m) {
  const SectorEdge front = find_sector(s, m, p);
  SectorEdge low = front, high = find_sector(s, m, end);
  const bool joined = m.joined && max(depth, m.depth) - min(back, m.back) <= slack;
  if (joined && m.last.place < low.place) low = m.last;
  if (joined && m.last.place > high.place) high = m.last;
  const uint fresh = sectors_below(high.place + dither) & ~sectors_below(low.place + dither) &
                     ~m.covered;
  if (fresh != 0u) {
    const float mean = mean_rho_of_matter(s, m, p, joined, low, high);
    const float piece = float(bitCount(fresh)) * m.span * mean / 32.0;
    m.sum += piece;
    if (kSums != kSumVisibility) {
      // What reaches above all before is new above that only.
      const bool above = low.place < m.top.place && high.place > m.top.place;
      SectorEdge new_end = high;
      if (above) new_end = m.top;
      const vec3 directions = directions_between(s, low, new_end);
      m.sum_directions += piece * directions.xy;
      m.sum_solid += piece * directions.z;
    }
    m.covered |= fresh;
  }
  m.point = p;
  m.depth = depth;
  m.back = back;
  m.last = front;
  if (low.place < m.top.place) m.top = low;
  m.joined = true;
}
