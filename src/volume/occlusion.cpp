#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <new>
#include <numbers>

#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "volume/grid_sampler.h"
#include "volume/transport.h"
#include "volume/volume_access.h"

namespace obscura {

// A position among the voxels of a grid.
struct Place {
  int index[3][2];      // the voxels beside it, those within the grid
  float share[3][2];    // of either
  float outside[3][2];  // voxels beyond the outermost, on the low and the high side, at most 1

  int corner(int corner, int axis) const { return index[axis][corner >> axis & 1]; }
  float corner_share(int corner) const {
    return share[0][corner & 1] * share[1][corner >> 1 & 1] * share[2][corner >> 2];
  }
  // Share of the visibility of the voxels within, for light from an octant. Voxels outside the grid
  // are open on the side of the light; on the other the voxels at the border stand for them.
  float within(int octant) const {
    float w = 1;
    for (int a = 0; a < 3; ++a) w *= 1 - outside[a][octant >> a & 1];
    return w;
  }
};

// Channels of octant s stand together, in half s >> 2.
class VisibilityFieldImpl {
 public:
  Transport transport{};
  TransportScheme scheme;
  std::shared_ptr<const PlaneTable> plane;
  std::array<int, 3> size{};
  Vec3 spacing{}, origin{};
  Vec3 end{};  // as far before the volume's border as `origin` is behind it
  float alpha = 1;
  bool shadow = false;
  Vec3 turned[3]{};  // shadow: axes of the grid in the volume's space
  std::unique_ptr<std::uint8_t[]> bytes[2];
  std::unique_ptr<float[]> floats[2];

  int directions() const { return static_cast<int>(scheme.directions.size()); }
  std::size_t voxels() const {
    return static_cast<std::size_t>(size[0]) * size[1] * static_cast<std::size_t>(size[2]);
  }
  std::size_t channels() const { return 4 * scheme.directions.size(); }
  // Another field's table, where it is the same.
  bool take_plane(const VisibilityFieldImpl& other) {
    if (!other.plane || other.transport != transport || other.spacing != spacing ||
        other.alpha != alpha) {
      return false;
    }
    plane = other.plane;
    return true;
  }
  // Another field's memory, where it fits: a volume swept again allocates nothing large.
  void take_bytes(VisibilityFieldImpl* other) {
    if (other->voxels() * other->channels() != voxels() * channels()) return;
    for (int half = 0; half < 2; ++half) bytes[half] = std::move(other->bytes[half]);
    *other = {};
  }
  bool has_half(int half) const { return bytes[half] || floats[half]; }

  // First channel of an octant in its half, and in all channels of both.
  int first_channel(int octant) const { return kSlotOfQuadrant[octant & 3] * directions(); }
  int first_of_all(int octant) const {
    return (octant >> 2) * static_cast<int>(channels()) + first_channel(octant);
  }

  // Adds share times the values of half a voxel's channels, in [0, 1], to sum.
  void add(int half, std::size_t voxel, float share, float* sum) const {
    const std::size_t at = voxel * channels();
    const int n = static_cast<int>(channels());
    if (bytes[half]) {
      const std::uint8_t* v = bytes[half].get() + at;
      share *= 1.0f / 255;
      for (int c = 0; c < n; ++c) sum[c] += share * static_cast<float>(v[c]);
    } else {
      const float* v = floats[half].get() + at;
      for (int c = 0; c < n; ++c) sum[c] += share * v[c];
    }
  }

  // Where a position of the field's own space lies among its voxels.
  Place place(const Vec3& p) const {
    Place at;
    for (int a = 0; a < 3; ++a) {
      const float u = (p[a] - origin[a]) / spacing[a], last = static_cast<float>(size[a] - 1);
      const float inside = std::clamp(u, 0.0f, last);
      const int i = std::min(static_cast<int>(inside), std::max(0, size[a] - 2));
      at.index[a][0] = i;
      at.index[a][1] = std::min(i + 1, size[a] - 1);
      at.share[a][1] = inside - static_cast<float>(i);
      at.share[a][0] = 1 - at.share[a][1];
      at.outside[a][0] = std::clamp(-u, 0.0f, 1.0f);
      at.outside[a][1] = std::clamp((p[a] - end[a]) / spacing[a], 0.0f, 1.0f);
    }
    return at;
  }

  // All channels there, trilinearly.
  void sample(const Place& at, int halves, float* sum) const {
    std::fill_n(sum, 2 * channels(), 0.0f);
    for (int corner = 0; corner < 8; ++corner) {
      const float s = at.corner_share(corner);
      if (s == 0) continue;
      const auto voxel = static_cast<std::size_t>(at.corner(corner, 0)) +
                         size[0] * (static_cast<std::size_t>(at.corner(corner, 1)) +
                                    static_cast<std::size_t>(size[1]) * at.corner(corner, 2));
      for (int half = 0; half < 2; ++half) {
        if (halves >> half & 1) add(half, voxel, s, sum + half * channels());
      }
    }
  }

  // Heights of the voxels there above the plane through a point of the surface.
  PlaneTable::Heights heights(const Place& at, const SurfacePoint& point) const {
    PlaneTable::Heights result(*plane);
    for (int corner = 0; corner < 8; ++corner) {
      const float s = at.corner_share(corner);
      if (s == 0) continue;
      float height = 0;
      for (int a = 0; a < 3; ++a) {
        height +=
            point.normal[a] *
            (origin[a] + spacing[a] * static_cast<float>(at.corner(corner, a)) - point.position[a]);
      }
      result.add(height, s);
    }
    return result;
  }
};

namespace {

constexpr int kMaxChannels = 8 * kMaxDirections;
constexpr int kBlock = 1024;  // points of a task
constexpr unsigned kShadowOctant = 7;

float unit_of(const Vec3& spacing) {
  return std::cbrt(spacing[0]) * std::cbrt(spacing[1]) * std::cbrt(spacing[2]);
}

// Sweeps the halves of the field that are asked for, through tau as bytes.
void sweep_halves(const std::uint8_t* tau, const OcclusionSettings& settings, int halves,
                  Executor& executor, Progress& progress, VisibilityFieldImpl* field) {
  const std::size_t samples = field->voxels() * field->channels();
  const SweepDirection* directions = field->scheme.directions.data();
  if (settings.precision == VisibilityPrecision::kU8) {
    for (int half = 0; half < 2; ++half) {
      if ((halves >> half & 1) && !field->bytes[half]) {
        field->bytes[half].reset(new std::uint8_t[samples]);
      }
    }
    executor.parallel_for(2, [&](int half, int) {
      if (!(halves >> half & 1) || progress.cancelled()) return;
      sweep_occlusion_u8(
          {tau, field->size, half == 0, directions, field->directions(), field->bytes[half].get()});
      progress.advance();
    });
    return;
  }
  std::vector<float> open(field->voxels());
  for (std::size_t i = 0; i < open.size(); ++i) open[i] = static_cast<float>(tau[i]) / 255;
  for (int half = 0; half < 2; ++half) {
    if (halves >> half & 1) field->floats[half].reset(new float[samples]);
  }
  const int channels = static_cast<int>(field->channels()), n = field->directions();
  executor.parallel_for(2 * channels, [&](int i, int) {
    const int half = i / channels, channel = i % channels, quadrant = kQuadrantOfSlot[channel / n];
    if (!(halves >> half & 1) || progress.cancelled()) return;
    sweep_occlusion_f32(open.data(), field->size,
                        {(quadrant & 1) != 0, (quadrant & 2) != 0, half == 1},
                        directions[channel % n], field->floats[half].get() + channel, channels);
    progress.advance();
  });
}

Status check(const GridView<const float>& distance, const OcclusionSettings& settings) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  return validate_grid("distance", distance.data, distance.size, distance.spacing);
}

Status out_of_memory() {
  return {StatusCode::kOutOfMemory, "out of memory in the occlusion sweep; use a smaller volume"};
}
Status cancelled() {
  return {StatusCode::kCancelled, "the occlusion sweep was cancelled by the caller"};
}

Status sweep(GridView<const float> distance, const OcclusionSettings& settings,
             VisibilityField* field, const RunOptions& run) {
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  VisibilityField result;
  VisibilityFieldImpl& f = result.impl();
  f.transport = settings.transport;
  f.scheme = transport_scheme(settings.transport, distance.spacing);
  f.alpha = settings.alpha;
  const int cell = f.scheme.cell;
  for (int a = 0; a < 3; ++a) {
    f.size[a] = (distance.size[a] + cell - 1) / cell;
    f.spacing[a] = cell * distance.spacing[a];
    f.origin[a] = 0.5f * static_cast<float>(cell - 1) * distance.spacing[a];
    // The last voxel of an odd number reaches beyond the border.
    f.end[a] = static_cast<float>(distance.size[a] - 1) * distance.spacing[a] - f.origin[a];
  }
  const float unit = unit_of(f.spacing);
  if (f.scheme.plane && !f.take_plane(field->impl())) {
    f.plane = std::make_shared<PlaneTable>(f.scheme, f.spacing, unit, settings.alpha, executor);
  }

  // Transmittance of a cell from the mean of its voxels' distances.
  const std::unique_ptr<std::uint8_t[]> tau(new std::uint8_t[f.voxels()]);
  const auto stride = distance.strides();
  const float scale = 1 / (unit * static_cast<float>(cell * cell * cell));
  executor.parallel_for(f.size[2], [&](int z, int) {
    for (int y = 0; y < f.size[1]; ++y) {
      const float* rows[4];
      int count = 0;
      for (int k = 0; k < cell; ++k) {
        for (int j = 0; j < cell; ++j) {
          rows[count++] = distance.data + std::min(z * cell + k, distance.size[2] - 1) * stride[2] +
                          std::min(y * cell + j, distance.size[1] - 1) * stride[1];
        }
      }
      transmittance_row(rows, count, stride[0], distance.size[0], cell, scale, settings.alpha,
                        tau.get() + static_cast<std::size_t>(f.size[0]) *
                                        (y + static_cast<std::size_t>(f.size[1]) * z));
    }
  });
  Progress progress(settings.precision == VisibilityPrecision::kU8
                        ? 2
                        : static_cast<std::int64_t>(2 * f.channels()),
                    run.progress);
  if (settings.precision == VisibilityPrecision::kU8) f.take_bytes(&field->impl());
  sweep_halves(tau.get(), settings, 3, executor, progress, &f);
  if (progress.cancelled()) return cancelled();
  *field = std::move(result);
  return {};
}

}  // namespace

VisibilityField::VisibilityField() : impl_(std::make_unique<VisibilityFieldImpl>()) {}
VisibilityField::~VisibilityField() = default;
VisibilityField::VisibilityField(VisibilityField&&) noexcept = default;
VisibilityField& VisibilityField::operator=(VisibilityField&&) noexcept = default;

bool VisibilityField::empty() const { return !impl_ || impl_->scheme.directions.empty(); }
std::array<int, 3> VisibilityField::size() const { return impl_->size; }
std::array<float, 3> VisibilityField::spacing() const { return impl_->spacing; }
std::array<float, 3> VisibilityField::origin() const { return impl_->origin; }
std::size_t VisibilityField::bytes() const {
  std::size_t sum = 0;
  for (int half = 0; half < 2; ++half) {
    if (impl_->bytes[half]) sum += impl_->voxels() * impl_->channels();
    if (impl_->floats[half]) sum += impl_->voxels() * impl_->channels() * sizeof(float);
  }
  return sum;
}

Status sweep_occlusion(GridView<const float> distance, const OcclusionSettings& settings,
                       VisibilityField* field, const RunOptions& run) {
  if (Status s = check(distance, settings); !s.ok()) return s;
  try {
    return sweep(distance, settings, field, run);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

namespace {

// A grid turned so that its axis (1, 1, 1) points to the light, around the whole volume.
Status sweep_turned(GridView<const float> distance, const Vec3& light,
                    const OcclusionSettings& settings, VisibilityField* field,
                    const RunOptions& run) {
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  VisibilityField result;
  VisibilityFieldImpl& f = result.impl();
  const float fine = *std::min_element(distance.spacing.begin(), distance.spacing.end());
  f.scheme = transport_scheme(settings.transport, {fine, fine, fine});
  f.scheme.plane = false;
  f.alpha = settings.alpha;
  f.shadow = true;
  const float side = fine * static_cast<float>(f.scheme.cell);
  f.spacing = {side, side, side};

  // The rotation about d x l that takes d = (1, 1, 1) / sqrt 3 to the light l, by Rodrigues.
  const float third = 1 / std::numbers::sqrt3_v<float>;
  const Vec3 d{third, third, third};
  const Vec3 v{d[1] * light[2] - d[2] * light[1], d[2] * light[0] - d[0] * light[2],
               d[0] * light[1] - d[1] * light[0]};
  const float c = d[0] * light[0] + d[1] * light[1] + d[2] * light[2];
  for (int a = 0; a < 3; ++a) {
    for (int b = 0; b < 3; ++b) {
      if (c < -0.9999f) {  // opposite: half a turn about an axis across d
        static constexpr float kAcross[3] = {0.70710678f, -0.70710678f, 0};
        f.turned[a][b] = 2 * kAcross[a] * kAcross[b] - (a == b);
        continue;
      }
      const float cross[3][3] = {{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}};
      float square = 0;
      for (int k = 0; k < 3; ++k) square += cross[b][k] * cross[k][a];
      f.turned[a][b] = (a == b) + cross[b][a] + square / (1 + c);
    }
  }
  Vec3 low{}, high{};
  for (int corner = 0; corner < 8; ++corner) {
    for (int a = 0; a < 3; ++a) {
      float u = 0;
      for (int b = 0; b < 3; ++b) {
        const float extent = distance.spacing[b] * static_cast<float>(distance.size[b] - 1);
        u += f.turned[a][b] * (corner >> b & 1 ? extent : 0);
      }
      low[a] = std::min(low[a], u);
      high[a] = std::max(high[a], u);
    }
  }
  f.origin = low;
  for (int a = 0; a < 3; ++a) {
    f.size[a] = static_cast<int>(std::ceil((high[a] - low[a]) / side)) + 1;
    f.end[a] = high[a];
  }
  const GridSampler sample(distance);
  std::vector<std::uint8_t> tau(f.voxels());
  executor.parallel_for(f.size[2], [&](int z, int) {
    std::uint8_t* out = tau.data() + static_cast<std::size_t>(z) * f.size[0] * f.size[1];
    for (int y = 0; y < f.size[1]; ++y) {
      for (int x = 0; x < f.size[0]; ++x, ++out) {
        const float q[3] = {low[0] + side * static_cast<float>(x),
                            low[1] + side * static_cast<float>(y),
                            low[2] + side * static_cast<float>(z)};
        Vec3 p{};
        for (int b = 0; b < 3; ++b) {
          for (int a = 0; a < 3; ++a) p[b] += f.turned[a][b] * q[a];
        }
        const float t = sample.inside(p) ? std::clamp(sample(p) / side + 0.5f, 0.0f, 1.0f) : 1.0f;
        *out = static_cast<std::uint8_t>(255 * (1 - (1 - t) * settings.alpha) + 0.5f);
      }
    }
  });
  const int half = static_cast<int>(kShadowOctant >> 2);
  Progress progress(
      settings.precision == VisibilityPrecision::kU8 ? 1 : static_cast<std::int64_t>(f.channels()),
      run.progress);
  sweep_halves(tau.data(), settings, 1 << half, executor, progress, &f);
  if (progress.cancelled()) return cancelled();
  *field = std::move(result);
  return {};
}

}  // namespace

Status sweep_shadow(GridView<const float> distance, std::array<float, 3> to_light,
                    const OcclusionSettings& settings, VisibilityField* field,
                    const RunOptions& run) {
  if (Status s = check(distance, settings); !s.ok()) return s;
  const float length = std::hypot(to_light[0], to_light[1], to_light[2]);
  if (!(length > 0 && std::isfinite(length))) {
    return invalid_argument(text("to_light is (", to_light[0], ", ", to_light[1], ", ", to_light[2],
                                 "); it must be finite and not zero"));
  }
  for (float& w : to_light) w /= length;
  try {
    return sweep_turned(distance, to_light, settings, field, run);
  } catch (const std::bad_alloc&) {
    return out_of_memory();
  }
}

Status VisibilityField::octant(int octant, GridView<float> visibility) const {
  if (empty()) return invalid_input("the visibility field is empty; sweep it first");
  const VisibilityFieldImpl& f = *impl_;
  if (octant < 0 || octant > 7 || !f.has_half(octant >> 2)) {
    return invalid_argument(text("octant is ", octant, "; it must be in [0, 7], of a shadow 7"));
  }
  if (visibility.data == nullptr || visibility.size != f.size) {
    return invalid_input(text("visibility must be a grid of ", f.size[0], "x", f.size[1], "x",
                              f.size[2], " samples, as the field's own"));
  }
  const auto stride = visibility.strides();
  const int n = f.directions();
  float values[4 * kMaxDirections];
  std::size_t voxel = 0;
  for (int z = 0; z < f.size[2]; ++z) {
    for (int y = 0; y < f.size[1]; ++y) {
      for (int x = 0; x < f.size[0]; ++x, ++voxel) {
        std::fill_n(values, f.channels(), 0.0f);
        f.add(octant >> 2, voxel, 1, values);
        float mean = 0;
        for (int i = 0; i < n; ++i) {
          mean += f.scheme.directions[i].weight * values[f.first_channel(octant) + i];
        }
        visibility.data[x * stride[0] + y * stride[1] + z * stride[2]] = std::min(mean, 1.0f);
      }
    }
  }
  return {};
}

Status VisibilityField::scalar(GridView<float> visibility, const RunOptions& run) const {
  if (empty()) return invalid_input("the visibility field is empty; sweep it first");
  const VisibilityFieldImpl& f = *impl_;
  if (visibility.data == nullptr || visibility.size != f.size) {
    return invalid_input(text("visibility must be a grid of ", f.size[0], "x", f.size[1], "x",
                              f.size[2], " samples, as the field's own"));
  }
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  const int n = static_cast<int>(f.channels());
  float weight[2][4 * kMaxDirections] = {};
  for (int s = f.shadow ? static_cast<int>(kShadowOctant) : 0; s < 8; ++s) {
    for (int i = 0; i < f.directions(); ++i) {
      weight[s >> 2][f.first_channel(s) + i] =
          f.scheme.directions[i].weight * (f.shadow ? 1.0f : 0.125f);
    }
  }
  const auto stride = visibility.strides();
  executor.parallel_for(f.size[2], [&](int z, int) {
    std::size_t voxel = static_cast<std::size_t>(z) * f.size[0] * f.size[1];
    for (int y = 0; y < f.size[1]; ++y) {
      float* out = visibility.data + z * stride[2] + y * stride[1];
      for (int x = 0; x < f.size[0]; ++x, ++voxel) {
        float sum = 0;
        for (int half = 0; half < 2; ++half) {
          const std::size_t at = voxel * f.channels();
          if (f.bytes[half]) {
            const std::uint8_t* v = f.bytes[half].get() + at;
            float bytes = 0;
            for (int c = 0; c < n; ++c) bytes += weight[half][c] * static_cast<float>(v[c]);
            sum += bytes * (1.0f / 255);
          } else if (f.floats[half]) {
            const float* v = f.floats[half].get() + at;
            for (int c = 0; c < n; ++c) sum += weight[half][c] * v[c];
          }
        }
        out[x * stride[0]] = std::min(sum, 1.0f);
      }
    }
  });
  return {};
}

namespace {

// Light at one point from the visibilities of all channels at its look-up.
float gather(const VisibilityFieldImpl& f, const LightSettings& light, const SurfacePoint& point,
             const Place& place, const float* visibility) {
  const int n = f.directions();
  const Vec3& normal = point.normal;
  if (f.shadow || !light.geometry_term) {
    float sum = 0, count = 0;
    for (int s = f.shadow ? 7 : 0; s < 8; ++s) {
      if (!f.shadow && !(light.octants >> s & 1)) continue;
      const float* v = visibility + f.first_of_all(s);
      const float within = place.within(s);
      for (int i = 0; i < n; ++i) {
        sum += f.scheme.directions[i].weight * (1 + within * (v[i] - 1));
      }
      ++count;
    }
    return std::min(sum / count, 1.0f);
  }
  const bool through = f.alpha < 1;
  float sum = 0, all = 0;
  float plane[PlaneTable::kRoom];
  std::fill_n(plane, PlaneTable::kRoom, 1.0f);
  PlaneTable::Heights heights;
  if (f.scheme.plane) heights = f.heights(place, point);
  for (int s = 0; s < 8; ++s) {
    const bool on = (light.octants >> s & 1) != 0;
    const float* v = visibility + f.first_of_all(s);
    const float within = place.within(s);
    if (n == 1 && !f.scheme.plane) {
      // Equation 4; seen through the surface, the other side's geometry term adds.
      const float g = octant_geometry(normal, s) +
                      (through ? octant_geometry({-normal[0], -normal[1], -normal[2]}, s) : 0.0f);
      if (on) sum += g * (1 + within * (v[0] - 1));
      all += g;
      continue;
    }
    Vec3 reflected = normal;
    for (int a = 0; a < 3; ++a) reflected[a] = s >> a & 1 ? normal[a] : -normal[a];
    if (!through && reflected[0] <= 0 && reflected[1] <= 0 && reflected[2] <= 0) continue;
    if (on && f.scheme.plane) f.plane->look_up(reflected, heights, plane);
    for (int i = 0; i < n; ++i) {
      const SweepDirection& d = f.scheme.directions[i];
      const float cosine = d.direction[0] * reflected[0] + d.direction[1] * reflected[1] +
                           d.direction[2] * reflected[2];
      if (cosine <= 0 && !through) continue;
      const float weight = d.weight * std::fabs(cosine);
      const float open = std::min(1.0f, cosine > 0 ? v[i] / plane[i] : v[i]);
      if (on) sum += weight * (1 + within * (open - 1));
      all += weight;
    }
  }
  return std::min(sum / all, 1.0f);
}

}  // namespace

Status VisibilityField::light(std::span<const SurfacePoint> points, const LightSettings& settings,
                              std::span<float> visibility, const RunOptions& run) const {
  if (empty()) return invalid_input("the visibility field is empty; sweep it first");
  if (settings.octants == 0 || settings.octants > kAllOctants) {
    return invalid_argument(text("octants is ", settings.octants, "; it must be in [1, 255]"));
  }
  if (visibility.size() != points.size()) {
    return invalid_input(text("visibility holds ", visibility.size(), " values; it must hold ",
                              points.size(), ", one per point"));
  }
  const RunThreads threads(run);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  const VisibilityFieldImpl& f = *impl_;
  int halves = 0;
  for (int half = 0; half < 2; ++half) {
    const bool wanted = f.shadow || (settings.octants >> (4 * half) & 0xF) != 0;
    halves |= int{f.has_half(half) && wanted} << half;
  }
  const std::size_t blocks = (points.size() + kBlock - 1) / kBlock;
  Progress progress(static_cast<std::int64_t>(blocks), run.progress);
  executor.parallel_for(static_cast<int>(blocks), [&](int block, int) {
    if (progress.cancelled()) return;
    const std::size_t begin = static_cast<std::size_t>(block) * kBlock;
    const std::size_t end = std::min(points.size(), begin + kBlock);
    float values[kMaxChannels];
    for (std::size_t i = begin; i < end; ++i) {
      const SurfacePoint& point = points[i];
      Vec3 p = point.position;
      for (int a = 0; a < 3; ++a) p[a] += f.scheme.lookup * f.spacing[a] * point.normal[a];
      if (f.shadow) {
        const Vec3 q = p;
        for (int a = 0; a < 3; ++a) {
          p[a] = f.turned[a][0] * q[0] + f.turned[a][1] * q[1] + f.turned[a][2] * q[2];
        }
      }
      const Place place = f.place(p);
      f.sample(place, halves, values);
      visibility[i] = gather(f, settings, point, place, values);
    }
    progress.advance();
  });
  if (progress.cancelled()) {
    return {StatusCode::kCancelled, "the look-up of light was cancelled by the caller"};
  }
  return {};
}

}  // namespace obscura
