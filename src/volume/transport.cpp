#include "volume/transport.h"

#include <algorithm>
#include <cmath>

namespace obscura {
namespace {

// Distance from a point to its look-up, in voxels of the half-resolution grid. If it is larger,
// narrow channels are missed; if it is smaller, the surface's own voxels darken it too much, the
// more so the more the stencil spreads light.
constexpr float kLookup = 0.6f, kUpwindLookup = 0.9f;

// Quadrature of an octant (Lathrop and Carlson's level-symmetric sets), one of each kind.
struct Kind {
  float x, y, z, weight;
};
constexpr Kind kS2[] = {{0.5773503f, 0.5773503f, 0.5773503f, 1.0f}};
constexpr Kind kS4[] = {{0.8688903f, 0.3500212f, 0.3500212f, 1.0f / 3},
                        {0.3500212f, 0.8688903f, 0.3500212f, 1.0f / 3},
                        {0.3500212f, 0.3500212f, 0.8688903f, 1.0f / 3}};
constexpr Kind kS6[] = {{0.9261808f, 0.2666355f, 0.2666355f, 0.1761263f},
                        {0.2666355f, 0.9261808f, 0.2666355f, 0.1761263f},
                        {0.2666355f, 0.2666355f, 0.9261808f, 0.1761263f},
                        {0.2666355f, 0.6815076f, 0.6815076f, 0.1572071f},
                        {0.6815076f, 0.2666355f, 0.6815076f, 0.1572071f},
                        {0.6815076f, 0.6815076f, 0.2666355f, 0.1572071f}};

constexpr Kind kS8[] = {{0.9511897f, 0.2182179f, 0.2182179f, 0.1209877f},
                        {0.2182179f, 0.9511897f, 0.2182179f, 0.1209877f},
                        {0.2182179f, 0.2182179f, 0.9511897f, 0.1209877f},
                        {0.2182179f, 0.5773503f, 0.7867958f, 0.0907407f},
                        {0.2182179f, 0.7867958f, 0.5773503f, 0.0907407f},
                        {0.5773503f, 0.2182179f, 0.7867958f, 0.0907407f},
                        {0.5773503f, 0.7867958f, 0.2182179f, 0.0907407f},
                        {0.7867958f, 0.2182179f, 0.5773503f, 0.0907407f},
                        {0.7867958f, 0.5773503f, 0.2182179f, 0.0907407f},
                        {0.5773503f, 0.5773503f, 0.5773503f, 0.0925926f}};

SweepDirection make_direction(const Kind& kind, Stencil stencil,
                              const std::array<float, 3>& spacing) {
  SweepDirection d;
  d.direction = {kind.x, kind.y, kind.z};
  d.weight = kind.weight;
  d.stencil = stencil;
  std::array<float, 3> w;  // in voxels
  for (int a = 0; a < 3; ++a) w[a] = d.direction[a] / spacing[a];
  if (stencil == Stencil::kUpwind) {
    const float sum = w[0] + w[1] + w[2];
    d.first = w[0] / sum;
    d.second = w[1] / sum;
  } else {
    d.axis = static_cast<int>(std::max_element(w.begin(), w.end()) - w.begin());
    d.first = w[d.axis == 0 ? 1 : 0] / w[d.axis];
    d.second = w[d.axis == 2 ? 1 : 2] / w[d.axis];
  }
  return d;
}

// Normals per side of the octahedral map; odd, so that the axes are among them.
constexpr int kTableSide = 17;
constexpr int kPerVoxel = 4;  // heights per voxel
constexpr int kReach = 3;     // voxels above and below the plane
constexpr int kHeights = PlaneTable::kHeights;
static_assert(kHeights == 2 * kReach * kPerVoxel + 1);

std::array<float, 3> octahedral(float u, float v) {  // u, v in [-1, 1]
  std::array<float, 3> n{u, v, 1 - std::fabs(u) - std::fabs(v)};
  if (n[2] < 0) {
    const float x = n[0];
    n[0] = std::copysign(1 - std::fabs(n[1]), x);
    n[1] = std::copysign(1 - std::fabs(x), n[1]);
  }
  const float length = std::hypot(n[0], n[1], n[2]);
  for (float& c : n) c /= length;
  return n;
}

// One direction above a plane: the scheme's value depends on the height alone.
class PlaneScheme {
 public:
  PlaneScheme(const SweepDirection& d, const std::array<float, 3>& normal,
              const std::array<float, 3>& spacing, float unit, float alpha)
      : per_height_(kPerVoxel / unit), unit_(unit), alpha_(alpha) {
    std::array<float, 3> rise;  // of the plane's height, one voxel towards the light
    for (int a = 0; a < 3; ++a) rise[a] = normal[a] * spacing[a];
    if (d.stencil == Stencil::kUpwind) {
      add(1 - d.first - d.second, rise[2]);
      add(d.first, rise[0]);
      add(d.second, rise[1]);
    } else {
      const int p = d.axis == 0 ? 1 : 0, q = d.axis == 2 ? 1 : 2;
      add((1 - d.first) * (1 - d.second), rise[d.axis]);
      add(d.first * (1 - d.second), rise[d.axis] + rise[p]);
      add((1 - d.first) * d.second, rise[d.axis] + rise[q]);
      add(d.first * d.second, rise[d.axis] + rise[p] + rise[q]);
    }
  }

  // Writes the visibility at height i of the table to out[i * step].
  void solve(float* out, int step) {
    std::fill_n(value_, kHeights, 1.0f);
    // Neighbours may lie lower than the voxel, so that one pass from above is not enough.
    for (int pass = 0; pass < 8; ++pass) {
      float change = 0;
      for (int i = kHeights - 1; i >= 0; --i) {
        const float h = static_cast<float>(i - kReach * kPerVoxel) / per_height_;
        float v = 0;
        for (int k = 0; k < count_; ++k) v += weight_[k] * onward(h + rise_[k]);
        change = std::max(change, std::fabs(v - value_[i]));
        value_[i] = v;
      }
      if (change < 1e-3f) break;
    }
    for (int i = 0; i < kHeights; ++i) out[i * step] = value_[i];
  }

 private:
  void add(float weight, float rise) {
    if (weight <= 0) return;
    weight_[count_] = weight;
    rise_[count_++] = rise;
  }
  float at(float h) const {
    const float u = h * per_height_ + kReach * kPerVoxel;
    if (u >= kHeights - 1) return value_[kHeights - 1];
    if (u <= 0) return value_[0];
    const int i = static_cast<int>(u);
    return value_[i] + (u - static_cast<float>(i)) * (value_[i + 1] - value_[i]);
  }
  float onward(float h) const {
    const float tau = std::clamp(h / unit_ + 0.5f, 0.0f, 1.0f);
    return at(h) * (1 - (1 - tau) * alpha_);
  }

  float per_height_, unit_, alpha_;
  int count_ = 0;
  float weight_[4], rise_[4], value_[kHeights];
};

}  // namespace

TransportScheme transport_scheme(Transport transport, const std::array<float, 3>& spacing) {
  TransportScheme s;
  auto add = [&](std::span<const Kind> kinds, Stencil stencil) {
    for (const Kind& k : kinds) s.directions.push_back(make_direction(k, stencil, spacing));
  };
  switch (transport) {
    case Transport::kPaper:
      // Equation 6 is a mean of the three neighbours, whatever the spacing.
      s.directions.push_back(make_direction(kS2[0], Stencil::kUpwind, {1, 1, 1}));
      break;
    case Transport::kFast:
      s.cell = 2;
      s.plane = true;
      s.lookup = kUpwindLookup;
      // With so few directions the wide beams of this stencil are needed: narrow beams draw stars.
      add(kS4, Stencil::kUpwind);
      break;
    case Transport::kBalanced:
      s.cell = 2;
      s.plane = true;
      s.lookup = kLookup;
      add(kS6, Stencil::kCharacteristic);
      break;
    case Transport::kAccurate:
      s.cell = 2;
      s.plane = true;
      s.lookup = kLookup;
      add(kS8, Stencil::kCharacteristic);
      break;
  }
  return s;
}

PlaneTable::PlaneTable(const TransportScheme& scheme, const std::array<float, 3>& spacing,
                       float unit, float alpha, Executor& executor)
    : pitch_((static_cast<int>(scheme.directions.size()) + 3) / 4 * 4),
      per_height_(kPerVoxel / unit),
      values_(static_cast<std::size_t>(kTableSide) * kTableSide * kHeights * pitch_, 1.0f) {
  executor.parallel_for(kTableSide, [&](int row, int) {
    for (int column = 0; column < kTableSide; ++column) {
      auto coordinate = [](int i) { return 2 * static_cast<float>(i) / (kTableSide - 1) - 1; };
      const auto normal = octahedral(coordinate(column), coordinate(row));
      float* out = values_.data() + node(column, row);
      for (std::size_t i = 0; i < scheme.directions.size(); ++i) {
        const auto& w = scheme.directions[i].direction;
        // Directions below the plane are never divided; those near it take part in interpolation.
        if (w[0] * normal[0] + w[1] * normal[1] + w[2] * normal[2] < -0.3f) continue;
        PlaneScheme(scheme.directions[i], normal, spacing, unit, alpha).solve(out + i, pitch_);
      }
    }
  });
}

std::size_t PlaneTable::node(int column, int row) const {
  return static_cast<std::size_t>(row * kTableSide + column) * kHeights * pitch_;
}

void PlaneTable::Heights::add(float height, float share) {
  const float u =
      std::clamp(height * per_height_ + kReach * kPerVoxel, 0.0f, static_cast<float>(kHeights - 1));
  const int i = std::min(static_cast<int>(u), kHeights - 2);
  const float above = share * (u - static_cast<float>(i));
  share_[i] += share - above;
  share_[i + 1] += above;
  first_ = std::min(first_, i);
  last_ = std::max(last_, i + 1);
}

void PlaneTable::look_up(const std::array<float, 3>& normal, const Heights& heights,
                         float values[kRoom]) const {
  const float sum = std::fabs(normal[0]) + std::fabs(normal[1]) + std::fabs(normal[2]);
  float u = normal[0] / sum, v = normal[1] / sum;
  if (normal[2] < 0) {
    const float x = u;
    u = std::copysign(1 - std::fabs(v), x);
    v = std::copysign(1 - std::fabs(x), v);
  }
  u = std::clamp((u + 1) * (kTableSide - 1) / 2, 0.0f, static_cast<float>(kTableSide - 1));
  v = std::clamp((v + 1) * (kTableSide - 1) / 2, 0.0f, static_cast<float>(kTableSide - 1));
  const int i = std::min(static_cast<int>(u), kTableSide - 2);
  const int j = std::min(static_cast<int>(v), kTableSide - 2);
  u -= static_cast<float>(i);
  v -= static_cast<float>(j);
  const float share[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
  const float* nodes[4];
  for (int c = 0; c < 4; ++c) nodes[c] = values_.data() + node(i + (c & 1), j + (c >> 1));
  if (pitch_ == 4) {
    mix<4>(nodes, share, heights, values);
  } else if (pitch_ == 8) {
    mix<8>(nodes, share, heights, values);
  } else {
    mix<kRoom>(nodes, share, heights, values);
  }
}

template <int kPitch>
void PlaneTable::mix(const float* const nodes[4], const float share[4], const Heights& heights,
                     float* values) {
  float sum[kPitch] = {};
  for (int h = heights.first_; h <= heights.last_; ++h) {
    const float weight = heights.share_[h];
    const float *a = nodes[0] + h * kPitch, *b = nodes[1] + h * kPitch;
    const float *c = nodes[2] + h * kPitch, *d = nodes[3] + h * kPitch;
    for (int k = 0; k < kPitch; ++k) {
      sum[k] += weight * (share[0] * a[k] + share[1] * b[k] + (share[2] * c[k] + share[3] * d[k]));
    }
  }
  for (int k = 0; k < kPitch; ++k) values[k] = std::max(sum[k], 1e-3f);
}

float octant_geometry(const std::array<float, 3>& normal, int octant) {
  // Reflected, the octant is the one of (+, +, +) and its corners are the axes.
  double n[3];
  for (int a = 0; a < 3; ++a) n[a] = octant >> a & 1 ? normal[a] : -double{normal[a]};
  double corner[4][3];
  int count = 0;
  for (int i = 0; i < 3; ++i) {
    const int k = (i + 1) % 3;
    if (n[i] >= 0) {
      for (int a = 0; a < 3; ++a) corner[count][a] = a == i;
      ++count;
    }
    if ((n[i] >= 0) != (n[k] >= 0)) {
      // The side from axis i to axis k meets the horizon where it is orthogonal to the normal.
      const double length = std::hypot(n[i], n[k]);
      for (int a = 0; a < 3; ++a) corner[count][a] = 0;
      corner[count][i] = std::fabs(n[k]) / length;
      corner[count][k] = std::fabs(n[i]) / length;
      ++count;
    }
  }
  // Lambert: half the sum over the sides of their angle times the normal's part along their pole.
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double *p = corner[i], *q = corner[(i + 1) % count];
    const double pole[3] = {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
                            p[0] * q[1] - p[1] * q[0]};
    const double sine = std::hypot(pole[0], pole[1], pole[2]);
    if (sine < 1e-12) continue;
    const double cosine = p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
    sum += std::atan2(sine, cosine) * (pole[0] * n[0] + pole[1] * n[1] + pole[2] * n[2]) / sine;
  }
  return static_cast<float>(std::max(0.0, sum / 2));
}

}  // namespace obscura
