#ifndef OBSCURA_SRC_LIGHTING_ENVIRONMENT_IMPL_H_
#define OBSCURA_SRC_LIGHTING_ENVIRONMENT_IMPL_H_

#include "lighting/radiance_map.h"
#include "obscura/environment.h"

namespace obscura {

class Environment::Impl {
 public:
  lighting::RadianceMap map;
  Sun sun;
};

namespace lighting {

// Cells of an environment's cube along a face's side.
inline constexpr int kRadianceCells = 128;

// Checks a sun and makes its direction unit.
Status check_sun(const Sun& sun, Sun* checked);

struct Rgb {
  float r = 0, g = 0, b = 0;
};

// An analytic sky, its scale applied.
class Sky {
 public:
  explicit Sky(const SkySettings& settings);  // valid settings
  Rgb radiance(const std::array<double, 3>& direction) const;
  const Sun& sun() const { return sun_; }

 private:
  // Perez' distribution of the chromaticities x, y and the luminance Y.
  struct Perez {
    double a = 0, b = 0, c = 0, d = 0, e = 0, zenith = 0;
    double at(double cos_theta, double gamma, double cos_gamma, double sun_theta) const;
  };
  Rgb above(double y, double cos_gamma) const;

  SkyModel model_;
  double sun_theta_ = 0;
  std::array<double, 3> to_sun_{};
  Perez luminance_, x_, y_;
  double scale_ = 1;
  Rgb ground_;
  Sun sun_;
};

}  // namespace lighting
}  // namespace obscura

#endif  // OBSCURA_SRC_LIGHTING_ENVIRONMENT_IMPL_H_
