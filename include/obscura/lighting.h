#ifndef OBSCURA_LIGHTING_H_
#define OBSCURA_LIGHTING_H_

#include <array>
#include <memory>
#include <span>

#include "obscura/environment.h"
#include "obscura/export.h"
#include "obscura/run_options.h"
#include "obscura/settings.h"
#include "obscura/status.h"

// Light from visibility, bent normals and cones (Klehm, Ritschel, Eisemann, Seidel 2011, section
// 3.3): an environment is convolved once, and a pixel costs a look-up.
namespace obscura {

struct PreconvolutionSettings {
  int cells = 32;
  int source_cells = 64;
};
template <FieldsOf<PreconvolutionSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.cells, Field{"cells", "cells", closed(4, 128), "Cells per edge of a cube face."});
  v(s.source_cells, Field{"source_cells", "cells", closed(8, 128),
                          "Cells of the summed light per edge of a cube face."});
}

// Radiance of a white diffuse surface by direction w and cone angle a,
//   L_c(w, a) = t/pi * integral of L(v) [angle(v, w) < a] (v.w) dv,   t = 1/sin^2(a),
// for eight angles from pi/16 to pi/2, linear between them. With this t a constant environment
// stays constant for every angle; L_c(w, pi/2) is L_p, the cosine-convolved environment. The cones'
// edges are softened by about one source cell. Immutable; copies share the data.
class OBSCURA_API PreconvolvedEnvironment {
 public:
  static constexpr int kLevels = 8;

  // The same bits for any number of threads. About 0.1 s of one processor at the default sizes.
  static Status make(const Environment& environment, const PreconvolutionSettings& settings,
                     PreconvolvedEnvironment* result, const RunOptions& options = {});

  // For caches: the table that an earlier make() returned with the same settings, and the sun.
  static Status from_table(const PreconvolutionSettings& settings, std::span<const float> table,
                           const Sun& sun, PreconvolvedEnvironment* result);
  std::span<const float> table() const;
  // Numbers in a table: 6 faces, (cells+1)^2 vertices, 8 levels, R, G, B and 0.
  static std::size_t table_size(const PreconvolutionSettings& settings);

  bool empty() const { return !impl_; }
  const Sun& sun() const;

  // L_c for one direction (world space, any length above 0) and angle in radians; not the sun.
  std::array<float, 3> radiance(const std::array<float, 3>& direction, float cone_angle) const;

  class Impl;
  const Impl* impl() const { return impl_.get(); }

 private:
  std::shared_ptr<const Impl> impl_;
};

enum class LightingTechnique {
  kAmbientOcclusion,  // visibility times L_p(normal)
  kBentNormal,        // visibility times L_p(bent normal)
  kBentCone,          // visibility times L_c(bent normal, cone angle)
};
template <>
struct EnumNames<LightingTechnique> {
  static constexpr const char* names[] = {"ambient-occlusion", "bent-normal", "bent-cone"};
};

enum class ConeNormalisation {
  kConstant,  // t = 1/sin^2(a): constant light stays constant
  kPaper,     // t = 1/(1 - cos a), Klehm et al. 2011, section 3.3: constant light
              // becomes 1 + cos a
};
template <>
struct EnumNames<ConeNormalisation> {
  static constexpr const char* names[] = {"constant", "paper"};
};

enum class VisibilityWeights {
  kCosine,   // 1/pi integral of V (n.w)
  kUniform,  // 1/(2 pi) integral of V, the paper's ambient occlusion
};
template <>
struct EnumNames<VisibilityWeights> {
  static constexpr const char* names[] = {"cosine", "uniform"};
};

// For an opening that is a cap of angle a around the axis N, the light under the geometric-term
// heuristic (n.w) ~ (N.w)(N.n) is cosine-weighted visibility times L_c, and equally uniform
// visibility times L_c (1 + cos a) (N.n). So the defaults go with cosine-weighted visibility, and
// `geometric_term` with `normalisation = paper` goes with uniform visibility.
struct LightingSettings {
  LightingTechnique technique = LightingTechnique::kBentCone;
  bool geometric_term = false;
  ConeNormalisation normalisation = ConeNormalisation::kConstant;
  VisibilityWeights weights = VisibilityWeights::kCosine;
  // Rotates eye space to world space; row-major, orthonormal.
  std::array<float, 9> world_from_eye{1, 0, 0, 0, 1, 0, 0, 0, 1};
};
template <FieldsOf<LightingSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.technique,
    Field{"technique",
          "",
          {},
          "What the light is looked up with: the normal, the bent normal or the cone."});
  v(s.geometric_term,
    Field{
        "geometric_term",
        "",
        {},
        "Multiply by the cosine between bent normal and normal (Klehm et al. 2011, section 3.4)."});
  v(s.normalisation,
    Field{"normalisation",
          "",
          {},
          "Scale of a cone's light: constant light stays constant, or as published."});
  v(s.weights,
    Field{"weights",
          "",
          {},
          "Weighting of the visibility: cosine or uniform; only matters for the sun's shadow."});
}

// Images of one size, in eye space. An empty view is left out where the technique does not need it.
struct LightingInputs {
  ImageView<const float> visibility{};    // clamped to [0, 1]; NaN: 1
  VectorView<const float> normal{};       // need not be unit; zero or not finite: (0, 0, 1)
  VectorView<const float> bent_normal{};  // need not be unit; zero or not finite: the normal
  ImageView<const float> cone_angle{};    // radians, clamped to [0, pi/2]; NaN: pi/2
  VectorView<const float> albedo{};       // optional; empty: 1
};

// Writes the light that each pixel reflects as linear RGB: the technique's value, plus the sun's,
// E/pi times visibility times max(0, n.s), or max(0, N.s) for bent normals. For bent cones it is
// E/pi max(0, n.s) times the part of the sun's disc within the cone times the share of the cone
// that is open. `out` has the inputs' size and may be one of them. The same bits for any number of
// threads.
OBSCURA_API Status light(const LightingInputs& inputs, const PreconvolvedEnvironment& environment,
                         const LightingSettings& settings, const VectorView<float>& out,
                         const RunOptions& options = {});

// Bent normal and cone whose cosine-weighted moments are those given, pixel by pixel: for light
// that is linear in direction the bent cone is then exact under any visibility. `cosine_integral`
// is Outputs::cosine_integral and `visibility` its cosine-weighted visibility. The angle is 0 where
// that is 0 (obscura/cone.h). Outputs may be inputs.
OBSCURA_API Status cones_from_cosine_integral(const ImageView<const float>& visibility,
                                              const VectorView<const float>& cosine_integral,
                                              const VectorView<float>& bent_normal,
                                              const ImageView<float>& cone_angle,
                                              const RunOptions& options = {});

}  // namespace obscura

#endif  // OBSCURA_LIGHTING_H_
