#ifndef OBSCURA_ENVIRONMENT_H_
#define OBSCURA_ENVIRONMENT_H_

#include <array>
#include <cstdint>
#include <memory>

#include "obscura/export.h"
#include "obscura/run_options.h"
#include "obscura/settings.h"
#include "obscura/views.h"

namespace obscura {

// Distant light: radiance by direction, and a sun. World space is right-handed with y up; a camera
// without rotation looks along -z.

// A disc of light too small and bright for the radiance map.
struct Sun {
  std::array<float, 3> direction{0, 1, 0};   // towards the sun, unit
  std::array<float, 3> irradiance{0, 0, 0};  // RGB on a surface that faces it; 0: no sun
  float angular_radius = 0.00465f;           // radians, [0, 0.5]

  bool shines() const { return irradiance[0] > 0 || irradiance[1] > 0 || irradiance[2] > 0; }
};

enum class SkyModel {
  kClear,     // Preetham, Shirley, Smits 1999, with colour
  kOvercast,  // CIE standard overcast sky (Moon and Spencer 1942), grey
  kUniform,   // the same radiance from everywhere, the ground too
};
template <>
struct EnumNames<SkyModel> {
  static constexpr const char* names[] = {"clear", "overcast", "uniform"};
};

// An analytic sky above a grey ground. The sky without its sun is scaled so that a white horizontal
// surface shows the radiance `intensity` (luminance; Rec. 709 primaries).
struct SkySettings {
  SkyModel model = SkyModel::kClear;
  float elevation_deg = 40;
  float azimuth_deg = 45;
  float turbidity = 3;
  float intensity = 1;
  float sun = 5;
  float ground_albedo = 0.2f;
};
template <FieldsOf<SkySettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.model, Field{"model", "", {}, "Clear sky (Preetham), CIE overcast sky, or uniform light."});
  v(s.elevation_deg,
    Field{"elevation_deg", "degrees", closed(2, 90), "The sun above the horizon."});
  v(s.azimuth_deg, Field{"azimuth_deg", "degrees", closed(-360, 360),
                         "The sun from straight ahead (-z) towards the right (+x)."});
  v(s.turbidity, Field{"turbidity", "", closed(2, 10), "Haze of the clear sky; 2 is very clear."});
  v(s.intensity, Field{"intensity", "radiance", closed(0, 1e6),
                       "What a white horizontal surface shows under the sky alone."});
  v(s.sun, Field{"sun", "ratio", closed(0, 1000),
                 "Irradiance facing the clear sky's sun over that of the sky on the ground."});
  v(s.ground_albedo, Field{"ground_albedo", "", closed(0, 1), "Reflectance of the ground."});
}

// What had to be mended in a map, in pixels.
struct EnvironmentRepairs {
  std::int64_t negative = 0;      // taken as 0
  std::int64_t not_a_number = 0;  // taken as 0
  std::int64_t infinite = 0;      // taken as the channel's largest finite value
  std::int64_t too_large = 0;     // over 1e30, taken as that

  bool any() const { return negative || not_a_number || infinite || too_large; }
};

// Immutable; copies share the data.
class OBSCURA_API Environment {
 public:
  // From a latitude-longitude map of linear RGB radiance, twice as wide as high, 4x2 to
  // 32768x16384. Its top row is up (+y), its middle column straight ahead (-z), right of it +x.
  // NaN, negative, infinite and huge values are mended as EnvironmentRepairs says; a map with
  // nothing but NaN or infinity in it is refused. The light is resampled to a cube of 128x128 cells
  // a face, without loss of energy. The same bits for any number of threads; of `options` only
  // they count.
  static Status from_lat_long(const VectorView<const float>& rgb, Environment* environment,
                              EnvironmentRepairs* repairs = nullptr,
                              const RunOptions& options = {});
  static Status from_sky(const SkySettings& settings, Environment* environment,
                         const RunOptions& options = {});

  bool empty() const { return !impl_; }

  // Radiance from `direction` (world space, any length above 0), without the sun.
  std::array<float, 3> radiance(const std::array<float, 3>& direction) const;

  const Sun& sun() const;
  // The same light with another sun; its direction need not be unit.
  Status with_sun(const Sun& sun, Environment* environment) const;

  class Impl;
  const Impl* impl() const { return impl_.get(); }

 private:
  std::shared_ptr<const Impl> impl_;
};

}  // namespace obscura

#endif  // OBSCURA_ENVIRONMENT_H_
