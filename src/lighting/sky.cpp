#include <algorithm>
#include <cmath>
#include <numbers>

#include "lighting/environment_impl.h"

// Clear sky: A. J. Preetham, P. Shirley, B. Smits, "A practical analytic model for daylight",
// SIGGRAPH 1999, appendix A.2 (sky) and A.1 (attenuation of the sun). Overcast sky: P. Moon, D. E.
// Spencer, "Illumination from a non-uniform sky", 1942; the CIE standard overcast sky.

namespace obscura::lighting {
namespace {

constexpr double kPi = std::numbers::pi;

double luminance_of(const Rgb& c) { return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b; }

Rgb scaled(const Rgb& c, double s) { return {float(c.r * s), float(c.g * s), float(c.b * s)}; }

// CIE xyY to linear Rec. 709; colours out of gamut are clipped.
Rgb rgb_of(double x, double y, double luminance) {
  const double X = luminance * x / y, Z = luminance * (1 - x - y) / y;
  auto clip = [](double v) { return static_cast<float>(std::max(v, 0.0)); };
  return {clip(3.2404542 * X - 1.5371385 * luminance - 0.4985314 * Z),
          clip(-0.9692660 * X + 1.8760108 * luminance + 0.0415560 * Z),
          clip(0.0556434 * X - 0.2040259 * luminance + 1.0572252 * Z)};
}

// Share of the sun's light that reaches the ground, Preetham's appendix A.1: Rayleigh scattering
// and aerosols (Angstrom's formula with exponent 1.3) along Kasten's relative air mass.
double sun_transmittance(double wavelength_um, double elevation, double turbidity) {
  const double degrees = elevation * 180 / kPi;
  const double mass = 1 / (std::sin(elevation) + 0.15 * std::pow(degrees + 3.885, -1.253));
  const double rayleigh = 0.008735 * std::pow(wavelength_um, -4.08);
  const double aerosols =
      std::max(0.04608 * turbidity - 0.04586, 0.0) * std::pow(wavelength_um, -1.3);
  return std::exp(-mass * (rayleigh + aerosols));
}

}  // namespace

// Perez' function relative to the zenith, times the zenith's value.
double Sky::Perez::at(double cos_theta, double gamma, double cos_gamma, double sun_theta) const {
  auto f = [this](double cos_t, double g, double cos_g) {
    return (1 + a * std::exp(b / cos_t)) * (1 + c * std::exp(d * g) + e * cos_g * cos_g);
  };
  return zenith * f(cos_theta, gamma, cos_gamma) / f(1, sun_theta, std::cos(sun_theta));
}

Rgb Sky::above(double y, double cos_gamma) const {
  switch (model_) {
    case SkyModel::kUniform:
      return {1, 1, 1};
    case SkyModel::kOvercast: {
      const auto v = static_cast<float>((1 + 2 * y) / 3);
      return {v, v, v};
    }
    case SkyModel::kClear:
      break;
  }
  const double cos_theta = std::max(y, 1e-3);  // the model has a pole on the horizon
  const double gamma = std::acos(std::clamp(cos_gamma, -1.0, 1.0));
  return rgb_of(x_.at(cos_theta, gamma, cos_gamma, sun_theta_),
                y_.at(cos_theta, gamma, cos_gamma, sun_theta_),
                luminance_.at(cos_theta, gamma, cos_gamma, sun_theta_));
}

Sky::Sky(const SkySettings& s) : model_(s.model) {
  const double elevation = s.elevation_deg * kPi / 180, azimuth = s.azimuth_deg * kPi / 180;
  const double t = s.turbidity;
  sun_theta_ = kPi / 2 - elevation;
  to_sun_ = {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
             -std::cos(elevation) * std::cos(azimuth)};

  const double th = sun_theta_, th2 = th * th, th3 = th2 * th;
  const double chi = (4.0 / 9 - t / 120) * (kPi - 2 * th);
  luminance_ = {0.1787 * t - 1.4630,
                -0.3554 * t + 0.4275,
                -0.0227 * t + 5.3251,
                0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703,
                std::max((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192, 0.01)};
  x_ = {-0.0193 * t - 0.2592,
        -0.0665 * t + 0.0008,
        -0.0004 * t + 0.2125,
        -0.0641 * t - 0.8989,
        -0.0033 * t + 0.0452,
        t * t * (0.00166 * th3 - 0.00375 * th2 + 0.00209 * th) +
            t * (-0.02903 * th3 + 0.06377 * th2 - 0.03202 * th + 0.00394) +
            (0.11693 * th3 - 0.21196 * th2 + 0.06052 * th + 0.25886)};
  y_ = {-0.0167 * t - 0.2608,
        -0.0950 * t + 0.0092,
        -0.0079 * t + 0.2102,
        -0.0441 * t - 1.6537,
        -0.0109 * t + 0.0529,
        t * t * (0.00275 * th3 - 0.00610 * th2 + 0.00317 * th) +
            t * (-0.04214 * th3 + 0.08970 * th2 - 0.04153 * th + 0.00516) +
            (0.15346 * th3 - 0.26756 * th2 + 0.06670 * th + 0.26688)};

  // Mean over the cosine-weighted hemisphere: the radiance of a white horizontal surface.
  Rgb mean;
  constexpr int kRings = 64, kSectors = 128;
  for (int i = 0; i < kRings; ++i) {
    const double y = std::sqrt((i + 0.5) / kRings), horizontal = std::sqrt(1 - y * y);
    for (int j = 0; j < kSectors; ++j) {
      const double phi = 2 * kPi * (j + 0.5) / kSectors;
      const double cos_gamma = horizontal * std::sin(phi) * to_sun_[0] + y * to_sun_[1] -
                               horizontal * std::cos(phi) * to_sun_[2];
      const Rgb c = above(y, cos_gamma);
      mean = {mean.r + c.r, mean.g + c.g, mean.b + c.b};
    }
  }
  mean = scaled(mean, 1.0 / (kRings * kSectors));
  scale_ = s.intensity / luminance_of(mean);
  ground_ = scaled(mean, scale_ * s.ground_albedo);

  if (model_ != SkyModel::kClear || s.sun == 0 || s.intensity == 0) return;
  for (int k = 0; k < 3; ++k) sun_.direction[k] = static_cast<float>(to_sun_[k]);
  // Dominant wavelengths of the primaries.
  Rgb colour{static_cast<float>(sun_transmittance(0.610, elevation, t)),
             static_cast<float>(sun_transmittance(0.550, elevation, t)),
             static_cast<float>(sun_transmittance(0.465, elevation, t))};
  colour = scaled(colour, kPi * s.intensity * s.sun / luminance_of(colour));
  sun_.irradiance = {colour.r, colour.g, colour.b};
  // The ground reflects the sun too.
  const double share = s.ground_albedo * to_sun_[1] / kPi;
  ground_ = {ground_.r + float(share * colour.r), ground_.g + float(share * colour.g),
             ground_.b + float(share * colour.b)};
}

Rgb Sky::radiance(const std::array<double, 3>& d) const {
  const double cos_gamma = d[0] * to_sun_[0] + d[1] * to_sun_[1] + d[2] * to_sun_[2];
  if (d[1] > 0 || model_ == SkyModel::kUniform) return scaled(above(d[1], cos_gamma), scale_);
  return ground_;
}

}  // namespace obscura::lighting
