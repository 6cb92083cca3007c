#include "lighting/radiance_map.h"

namespace obscura::lighting {

void LightSum::add(const std::array<float, 3>& direction, double solid_angle, double r, double g,
                   double b) {
  const CubeGrid::Hit h = grid_.hit(direction);
  const double u = h.u, v = h.v;
  const std::size_t side = grid_.side();
  auto give = [&](std::size_t index, double share) {
    Sample& s = sums_[index];
    const double w = share * solid_angle;
    s.energy[0] += w * r;
    s.energy[1] += w * g;
    s.energy[2] += w * b;
    s.solid_angle += w;
  };
  give(h.index, (1 - u) * (1 - v));
  give(h.index + 1, u * (1 - v));
  give(h.index + side, (1 - u) * v);
  give(h.index + side + 1, u * v);
}

void LightSum::add(const LightSum& other) {
  for (std::size_t k = 0; k < sums_.size(); ++k) {
    for (int c = 0; c < 3; ++c) sums_[k].energy[c] += other.sums_[k].energy[c];
    sums_[k].solid_angle += other.sums_[k].solid_angle;
  }
}

void LightSum::gather_edges() {
  grid_.for_each([&](CubeGrid::Vertex v) {
    const CubeGrid::Vertex o = grid_.owner(v);
    if (o.face == v.face) return;
    Sample& from = sums_[grid_.index(v.face, v.i, v.j)];
    Sample& to = sums_[grid_.index(o.face, o.i, o.j)];
    for (int c = 0; c < 3; ++c) to.energy[c] += from.energy[c];
    to.solid_angle += from.solid_angle;
    from = {};
  });
}

RadianceMap::RadianceMap(LightSum sum) : grid(sum.grid()), texels(grid.vertices()) {
  sum.gather_edges();
  grid.for_each([&](CubeGrid::Vertex v) {
    const CubeGrid::Vertex o = grid.owner(v);
    const LightSum::Sample& s = sum.samples()[grid.index(o.face, o.i, o.j)];
    Texel& t = texels[grid.index(v.face, v.i, v.j)];
    t.r = static_cast<float>(s.energy[0] / s.solid_angle);
    t.g = static_cast<float>(s.energy[1] / s.solid_angle);
    t.b = static_cast<float>(s.energy[2] / s.solid_angle);
    t.solid_angle = o.face == v.face ? static_cast<float>(s.solid_angle) : 0;
  });
}

std::array<float, 3> RadianceMap::radiance(const std::array<float, 3>& direction) const {
  const CubeGrid::Hit h = grid.hit(direction);
  const Texel *a = &texels[h.index], *b = a + grid.side();
  auto mix = [&](float Texel::*c) {
    const float top = a[0].*c + h.u * (a[1].*c - a[0].*c);
    const float bottom = b[0].*c + h.u * (b[1].*c - b[0].*c);
    return top + h.v * (bottom - top);
  };
  return {mix(&Texel::r), mix(&Texel::g), mix(&Texel::b)};
}

RadianceMap RadianceMap::coarser(CubeGrid to) const {
  LightSum sum(to);
  grid.for_each([&](CubeGrid::Vertex v) {
    const Texel& t = texels[grid.index(v.face, v.i, v.j)];
    if (t.solid_angle > 0) sum.add(grid.direction(v), t.solid_angle, t.r, t.g, t.b);
  });
  return RadianceMap(std::move(sum));
}

}  // namespace obscura::lighting
