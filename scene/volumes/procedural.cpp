#include "scene/volumes/procedural.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "obscura/executor.h"

namespace obscura::tools {
namespace {

constexpr std::string_view kPrefix = "volume:";
constexpr double kPi = std::numbers::pi;

struct Options {
  int size = 128;
  std::uint32_t seed = 1;
};
template <FieldsOf<Options> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.size, Field{"size", "voxels", closed(2, 2048), "Voxels along each side."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}

// Uniform numbers in [0, 1) from a seed (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double operator()() {
    state_ += 0x9E3779B97F4A7C15u;
    std::uint64_t v = state_;
    v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
    v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
    return double((v ^ (v >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

// Fields below are signed distances, negative in matter, in the cube [0, 1]^3 with z up.
using Shape = std::function<double(const Double3&)>;

double length(double x, double y, double z) { return std::sqrt(x * x + y * y + z * z); }

double sphere(const Double3& p, const Double3& c, double r) {
  return length(p[0] - c[0], p[1] - c[1], p[2] - c[2]) - r;
}

double capsule(const Double3& p, const Double3& a, const Double3& b, double r) {
  double along = 0, squared = 0;
  for (int k = 0; k < 3; ++k) {
    along += (p[k] - a[k]) * (b[k] - a[k]);
    squared += (b[k] - a[k]) * (b[k] - a[k]);
  }
  const double t = squared > 0 ? std::clamp(along / squared, 0.0, 1.0) : 0;
  return length(p[0] - a[0] - t * (b[0] - a[0]), p[1] - a[1] - t * (b[1] - a[1]),
                p[2] - a[2] - t * (b[2] - a[2])) -
         r;
}

double box(const Double3& p, const Double3& c, const Double3& half) {
  double outside[3], inside = -1e9;
  for (int k = 0; k < 3; ++k) {
    const double d = std::abs(p[k] - c[k]) - half[k];
    outside[k] = std::max(d, 0.0);
    inside = std::max(inside, d);
  }
  return length(outside[0], outside[1], outside[2]) + std::min(inside, 0.0);
}

// Upright cylinder, or cylinder shell, about the axis through (x, y).
double cylinder(const Double3& p, double x, double y, double r, double bottom, double top) {
  const double radial = std::hypot(p[0] - x, p[1] - y) - r;
  const double axial = std::abs(p[2] - (bottom + top) / 2) - (top - bottom) / 2;
  return std::hypot(std::max(radial, 0.0), std::max(axial, 0.0)) +
         std::min(std::max(radial, axial), 0.0);
}

Shape gyroid(std::uint32_t) {
  return [](const Double3& p) {
    constexpr double kFrequency = 6 * kPi;  // three periods
    const double x = kFrequency * p[0], y = kFrequency * p[1], z = kFrequency * p[2];
    // Its gradient's length is about 1.5 times the frequency on the surface.
    return (std::sin(x) * std::cos(y) + std::sin(y) * std::cos(z) + std::sin(z) * std::cos(x)) /
           (1.5 * kFrequency);
  };
}

Shape lone_sphere(std::uint32_t) {
  return [](const Double3& p) { return sphere(p, {0.5, 0.5, 0.5}, 0.3); };
}

Shape sphere_over_plane(std::uint32_t) {
  return [](const Double3& p) { return std::min(p[2] - 0.15, sphere(p, {0.5, 0.5, 0.5}, 0.2)); };
}

Shape pillars(std::uint32_t seed) {
  Random random(seed);
  std::vector<std::array<double, 3>> feet;  // x, y, height
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      feet.push_back({0.2 + 0.2 * i + 0.04 * (random() - 0.5),
                      0.2 + 0.2 * j + 0.04 * (random() - 0.5), 0.4 + 0.4 * random()});
    }
  }
  return [feet](const Double3& p) {
    double d = p[2] - 0.1;
    for (const auto& [x, y, height] : feet) {
      d = std::min(d, cylinder(p, x, y, 0.045, 0.0, height));
    }
    return d;
  };
}

Shape cup(std::uint32_t) {
  return [](const Double3& p) {
    const double outer = cylinder(p, 0.5, 0.5, 0.32, 0.12, 0.85);
    const double hollow = cylinder(p, 0.5, 0.5, 0.26, 0.2, 1.5);
    return std::max(outer, -hollow);
  };
}

Shape open_box(std::uint32_t) {
  return [](const Double3& p) {
    const double outer = box(p, {0.5, 0.5, 0.45}, {0.35, 0.35, 0.33});
    const double hollow = box(p, {0.5, 0.5, 0.85}, {0.29, 0.29, 0.67});
    return std::max(outer, -hollow);
  };
}

// A tree of tapering tubes.
Shape vessels(std::uint32_t seed) {
  struct Tube {
    Double3 from, to;
    double radius;
  };
  Random random(seed);
  std::vector<Tube> tubes;
  std::vector<std::pair<Tube, int>> open = {{{{0.5, 0.5, 0.05}, {0.5, 0.5, 0.3}, 0.045}, 0}};
  while (!open.empty()) {
    const auto [tube, depth] = open.back();
    open.pop_back();
    tubes.push_back(tube);
    if (depth == 6) continue;
    Double3 axis;
    double size = 0;
    for (int k = 0; k < 3; ++k) axis[k] = tube.to[k] - tube.from[k];
    size = length(axis[0], axis[1], axis[2]);
    const double turn = 2 * kPi * random();
    for (int child = 0; child < 2; ++child) {
      const double spread = child == 0 ? 0.55 + 0.3 * random() : -0.55 - 0.3 * random();
      // Two directions across the axis; any will do.
      const Double3 helper = std::abs(axis[2]) < 0.8 * size
                                 ? Double3{0, 0, 1}
                                 : Double3{std::cos(turn), std::sin(turn), 0};
      Double3 across = {axis[1] * helper[2] - axis[2] * helper[1],
                        axis[2] * helper[0] - axis[0] * helper[2],
                        axis[0] * helper[1] - axis[1] * helper[0]};
      const double width = length(across[0], across[1], across[2]);
      Double3 other = {axis[1] * across[2] - axis[2] * across[1],
                       axis[2] * across[0] - axis[0] * across[2],
                       axis[0] * across[1] - axis[1] * across[0]};
      const double other_width = length(other[0], other[1], other[2]);
      Tube next;
      next.from = tube.to;
      for (int k = 0; k < 3; ++k) {
        const double side =
            std::cos(turn) * across[k] / width + std::sin(turn) * other[k] / other_width;
        const double direction = std::cos(spread) * axis[k] / size + std::sin(spread) * side;
        next.to[k] = std::clamp(tube.to[k] + 0.8 * size * direction, 0.06, 0.94);
      }
      next.radius = std::max(0.012, 0.78 * tube.radius);
      open.push_back({next, depth + 1});
    }
  }
  return [tubes](const Double3& p) {
    double d = 1e9;
    for (const Tube& t : tubes) d = std::min(d, capsule(p, t.from, t.to, t.radius));
    return d;
  };
}

// Puffs on puffs: balls around a flat-bottomed heap, each with smaller ones on it.
Shape cloud(std::uint32_t seed) {
  struct Puff {
    Double3 centre;
    double radius;
  };
  Random random(seed);
  std::vector<Puff> puffs;
  auto grow = [&](const Puff& on, double share) {
    const double turn = 2 * kPi * random(), height = 2 * random() - 0.7;
    const double up = std::clamp(height, -1.0, 1.0), across = std::sqrt(1 - up * up);
    Puff next;
    next.radius = on.radius * share * (0.7 + 0.6 * random());
    const double reach = on.radius * 0.95;
    next.centre = {on.centre[0] + reach * across * std::cos(turn),
                   on.centre[1] + reach * across * std::sin(turn), on.centre[2] + reach * up};
    puffs.push_back(next);
    return next;
  };
  for (int i = 0; i < 5; ++i) {
    puffs.push_back({{0.28 + 0.11 * i, 0.5 + 0.08 * (random() - 0.5), 0.42 + 0.05 * random()},
                     0.1 + 0.05 * random()});
  }
  for (int i = 0; i < 5; ++i) {
    for (int j = 0; j < 7; ++j) {
      const Puff middle = grow(Puff(puffs[std::size_t(i)]), 0.5);
      for (int k = 0; k < 4; ++k) grow(middle, 0.45);
    }
  }
  return [puffs](const Double3& p) {
    double d = 1e9;
    for (const Puff& puff : puffs) {
      // A rounded union: lower than both by up to a quarter of the width where they meet.
      constexpr double kWidth = 0.015;
      const double e = sphere(p, puff.centre, puff.radius);
      const double h = std::max(kWidth - std::abs(d - e), 0.0) / kWidth;
      d = std::min(d, e) - h * h * kWidth / 4;
    }
    return std::max(d, 0.36 - p[2]);
  };
}

struct Kind {
  const char* name;
  Shape (*make)(std::uint32_t seed);
};
constexpr Kind kKinds[] = {{"gyroid", gyroid},
                           {"sphere", lone_sphere},
                           {"sphere-over-plane", sphere_over_plane},
                           {"pillars", pillars},
                           {"cup", cup},
                           {"open-box", open_box},
                           {"vessels", vessels},
                           {"cloud", cloud}};

Status parse(const std::string& spec, const Kind** kind, Options* options) {
  std::string_view rest = std::string_view(spec).substr(kPrefix.size());
  const std::size_t question = rest.find('?');
  const std::string_view name = rest.substr(0, question);
  *kind = nullptr;
  for (const Kind& k : kKinds) {
    if (name == k.name) *kind = &k;
  }
  if (!*kind) {
    return invalid_argument(fmt::format("there is no volume \"{}\"; the volumes are {}", name,
                                        procedural_volume_names()));
  }
  rest.remove_prefix(question == std::string_view::npos ? rest.size() : question + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
    const std::size_t equals = std::min(pair.find('='), pair.size());
    const std::string key(pair.substr(0, equals));
    const std::string_view value = pair.substr(std::min(pair.size(), equals + 1));
    bool known = false;
    Status status;
    visit_fields(*options, [&](auto& field_value, const Field& field) {
      if (key != field.name) return;
      known = true;
      status = parse_setting(fmt::format("{}: {}", spec, key), field, value, &field_value);
    });
    if (!status.ok()) return status;
    if (!known) {
      return invalid_argument(
          fmt::format("{}: there is no key \"{}\"; volumes have size and seed", spec, key));
    }
  }
  return {};
}

}  // namespace

bool is_procedural_volume(const std::string& spec) { return spec.starts_with(kPrefix); }

std::string procedural_volume_names() {
  std::string names;
  for (const Kind& k : kKinds) {
    names += fmt::format("{}{}{}", names.empty() ? "" : ", ", kPrefix, k.name);
  }
  return names;
}

Status make_procedural_volume(const std::string& spec, VolumeImage* image, int threads) {
  const Kind* kind = nullptr;
  Options options;
  if (Status s = parse(spec, &kind, &options); !s.ok()) return s;
  const int n = options.size;
  VolumeImage result;
  result.name = spec;
  result.format = "procedural";
  result.size = {n, n, n};
  const double h = 1.0 / n;
  for (int a = 0; a < 3; ++a) {
    result.axes[a] = {};
    result.axes[a][a] = h;
    result.origin[a] = 0.5 * h;
  }
  result.isovalue = 0.0f;
  result.solid = SolidSide::kAbove;
  result.samples.resize(std::size_t(result.voxels()) * sizeof(float));
  auto* out = reinterpret_cast<float*>(result.samples.data());
  const Shape shape = kind->make(options.seed);
  const auto executor = make_executor(threads);
  executor->parallel_for(n, [&](int z, int) {
    float* row = out + std::size_t(z) * n * n;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        *row++ = float(-shape({(x + 0.5) * h, (y + 0.5) * h, (z + 0.5) * h}));
      }
    }
  });
  *image = std::move(result);
  return {};
}

}  // namespace obscura::tools
