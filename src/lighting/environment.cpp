#include "obscura/environment.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <numbers>

#include "core/run_threads.h"
#include "core/text.h"
#include "lighting/environment_impl.h"

namespace obscura {

using lighting::CubeGrid;
using lighting::LightSum;
using lighting::RadianceMap;
using lighting::Rgb;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kLargest = 1e30f;

struct Mend {
  std::array<float, 3> largest{};  // finite values only
  EnvironmentRepairs repairs;
  bool usable = false;

  void scan(const VectorView<const float>& rgb) {
    const ImageView<const float>* channels[] = {&rgb.x, &rgb.y, &rgb.z};
    for (int y = 0; y < rgb.x.height; ++y) {
      for (int x = 0; x < rgb.x.width; ++x) {
        bool nan = false, negative = false, infinite = false, large = false;
        for (int c = 0; c < 3; ++c) {
          const float v = (*channels[c])(x, y);
          nan = nan || std::isnan(v);
          negative = negative || v < 0;
          infinite = infinite || v == std::numeric_limits<float>::infinity();
          large = large || (v > kLargest && std::isfinite(v));
          if (!std::isfinite(v)) continue;
          usable = true;
          largest[c] = std::max(largest[c], std::min(v, kLargest));
        }
        repairs.not_a_number += nan;
        repairs.negative += negative;
        repairs.infinite += infinite;
        repairs.too_large += large;
      }
    }
  }
  float operator()(float v, int c) const {
    if (!(v > 0)) return 0;  // NaN too
    return std::isinf(v) ? largest[c] : std::min(v, kLargest);
  }
};

// Shares the light of a latitude-longitude map, value(x, y), among a cube's vertices. Pixels are
// split until several fall into each cell of the cube.
template <class Value>
RadianceMap resample(int width, int height, const Value& value, Executor& executor) {
  const CubeGrid grid{lighting::kRadianceCells};
  // The smallest cells lie in the faces' corners; their height there is at least a third of this.
  const double cell = 2.0 / grid.cells;
  const int split = std::max(1, static_cast<int>(std::ceil(kPi / height / (cell / 6))));
  const int columns = width * split;
  std::vector<float> sines(columns), cosines(columns);
  for (int k = 0; k < columns; ++k) {
    const double phi = 2 * kPi * ((k + 0.5) / columns - 0.5);
    sines[k] = static_cast<float>(std::sin(phi));
    cosines[k] = static_cast<float>(std::cos(phi));
  }
  // A fixed number of sums, added in order: the same bits for any number of threads.
  constexpr int kBands = 8;
  std::vector<LightSum> bands(kBands, LightSum(grid));
  const int rows = height * split;
  executor.parallel_for(kBands, [&](int band, int) {
    const auto first = static_cast<int>(std::int64_t{rows} * band / kBands);
    const auto end = static_cast<int>(std::int64_t{rows} * (band + 1) / kBands);
    for (int j = first; j < end; ++j) {
      const double upper = kPi * j / rows, lower = kPi * (j + 1) / rows;
      const double theta = 0.5 * (upper + lower);
      const auto sin_theta = static_cast<float>(std::sin(theta));
      const auto cos_theta = static_cast<float>(std::cos(theta));
      const double solid_angle = (std::cos(upper) - std::cos(lower)) * 2 * kPi / columns;
      for (int x = 0; x < width; ++x) {
        const Rgb v = value(x, j / split);
        for (int k = x * split; k < (x + 1) * split; ++k) {
          bands[band].add({sin_theta * sines[k], cos_theta, -sin_theta * cosines[k]}, solid_angle,
                          v.r, v.g, v.b);
        }
      }
    }
  });
  for (int band = 1; band < kBands; ++band) bands[0].add(bands[band]);
  return RadianceMap(std::move(bands[0]));
}

Status check_map(const VectorView<const float>& rgb) {
  for (const ImageView<const float>* c : {&rgb.x, &rgb.y, &rgb.z}) {
    if (c->empty()) return invalid_input("the environment lacks a channel; it needs R, G and B");
    if (c->width != rgb.x.width || c->height != rgb.x.height) {
      return invalid_input("the environment's channels differ in size");
    }
  }
  const int w = rgb.x.width, h = rgb.x.height;
  if (w != 2 * h || h < 2 || h > 16384) {
    return invalid_input(text("the environment is ", w, "x", h,
                              "; a latitude-longitude map is twice as wide as high, from 4x2 to "
                              "32768x16384"));
  }
  return {};
}

}  // namespace

namespace lighting {

Status check_sun(const Sun& sun, Sun* checked) {
  double square = 0;
  for (float c : sun.direction) square += double{c} * c;
  if (!(square > 0) || !std::isfinite(square)) {
    return invalid_argument(text("sun direction is (", sun.direction[0], ", ", sun.direction[1],
                                 ", ", sun.direction[2], "); it must be finite and not zero"));
  }
  for (float c : sun.irradiance) {
    if (!(c >= 0 && c <= kLargest)) {
      return invalid_argument(text("sun irradiance is ", c, "; it must be in [0, 1e30]"));
    }
  }
  if (!(sun.angular_radius >= 0 && sun.angular_radius <= 0.5f)) {
    return invalid_argument(
        text("sun angular radius is ", sun.angular_radius, "; it must be in [0, 0.5] radians"));
  }
  *checked = sun;
  for (float& c : checked->direction) c = static_cast<float>(c / std::sqrt(square));
  return {};
}

}  // namespace lighting

Status Environment::from_lat_long(const VectorView<const float>& rgb, Environment* environment,
                                  EnvironmentRepairs* repairs, const RunOptions& options) {
  const RunThreads threads(options);
  if (!threads.status().ok()) return threads.status();
  if (Status s = check_map(rgb); !s.ok()) return s;
  Mend mend;
  mend.scan(rgb);
  if (!mend.usable) {
    return invalid_input("the environment holds no finite value; it must hold radiance");
  }
  try {
    auto impl = std::make_shared<Impl>();
    impl->map = resample(
        rgb.x.width, rgb.x.height,
        [&](int x, int y) {
          return Rgb{mend(rgb.x(x, y), 0), mend(rgb.y(x, y), 1), mend(rgb.z(x, y), 2)};
        },
        threads.executor());
    environment->impl_ = std::move(impl);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while reading the environment"};
  }
  if (repairs) *repairs = mend.repairs;
  return {};
}

Status Environment::from_sky(const SkySettings& settings, Environment* environment,
                             const RunOptions& options) {
  const RunThreads threads(options);
  if (!threads.status().ok()) return threads.status();
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  try {
    auto impl = std::make_shared<Impl>();
    const lighting::Sky sky(settings);
    constexpr int kWidth = 1024, kHeight = 512;  // even, so that the horizon is between rows
    std::vector<Rgb> pixels(std::size_t{kWidth} * kHeight);
    for (int y = 0; y < kHeight; ++y) {
      const double theta = kPi * (y + 0.5) / kHeight;
      for (int x = 0; x < kWidth; ++x) {
        const double phi = 2 * kPi * ((x + 0.5) / kWidth - 0.5);
        pixels[std::size_t(y) * kWidth + x] = sky.radiance(
            {std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)});
      }
    }
    impl->map = resample(
        kWidth, kHeight, [&](int x, int y) { return pixels[std::size_t(y) * kWidth + x]; },
        threads.executor());
    impl->sun = sky.sun();
    environment->impl_ = std::move(impl);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while making the sky"};
  }
  return {};
}

std::array<float, 3> Environment::radiance(const std::array<float, 3>& direction) const {
  return impl_->map.radiance(direction);
}

const Sun& Environment::sun() const { return impl_->sun; }

Status Environment::with_sun(const Sun& sun, Environment* environment) const {
  if (!impl_) return invalid_argument("the environment is empty");
  Sun checked;
  if (Status s = lighting::check_sun(sun, &checked); !s.ok()) return s;
  auto impl = std::make_shared<Impl>(*impl_);
  impl->sun = checked;
  environment->impl_ = std::move(impl);
  return {};
}

}  // namespace obscura
