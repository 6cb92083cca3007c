#ifndef OBSCURA_IMPORTANCE_H_
#define OBSCURA_IMPORTANCE_H_

#include <array>
#include <cstdint>

#include "obscura/depth_field.h"
#include "obscura/environment.h"
#include "obscura/export.h"
#include "obscura/falloff.h"
#include "obscura/occluder.h"
#include "obscura/run_options.h"
#include "obscura/settings.h"

namespace obscura {

// Importance sampling of an environment with screen-space visibility: what bent cones are compared
// with (bent normals and cones, Klehm et al. 2011, section 5.2). A comparator, not a fast path.
// Takes the falloffs constant and quadratic, and the occluders solid and thickness.
struct OBSCURA_EXPERIMENTAL ImportanceSettings {
  Falloff falloff{.kind = FalloffKind::kConstant};
  Occluder occluder{};
  int samples = 32;
  int steps = 3;
  int interleave = 8;
  bool blur = true;
  std::uint32_t seed = 1;
  // Rotates eye space to world space; row-major, orthonormal.
  std::array<float, 9> world_from_eye{1, 0, 0, 0, 1, 0, 0, 0, 1};
};
template <FieldsOf<ImportanceSettings> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  visit_fields(s.falloff, v);
  v(s.occluder, Field{"occluder",
                      "world units",
                      {},
                      "How thick matter is assumed to be behind each depth sample."});
  v(s.samples, Field{"samples", "per pixel", closed(1, 256),
                     "Directions, chosen in proportion to the light."});
  v(s.steps, Field{"steps", "per sample", closed(1, 64), "Points tested along each direction."});
  v(s.interleave, Field{"interleave", "pixels", closed(1, 16),
                        "Size m of the m x m pixels that share one larger set."});
  v(s.blur, Field{"blur", "", {}, "Blur the result, keeping edges."});
  v(s.seed, Field{"seed", "", anything(), "Seed of the random numbers."});
}

// The light that a white diffuse surface reflects, linear RGB of the visible size: the mean over
// directions w, chosen with a density p(w) in proportion to the environment's radiance and the
// sun's power, of V(w) L(w) max(0, n.w) / (pi p(w)). 0 on the background. V is 0 beyond the first
// tested point that lies in matter (1 - rho there with a quadratic falloff). The same bits for any
// number of threads.
OBSCURA_API OBSCURA_EXPERIMENTAL Status light_by_importance(const DepthField& field,
                                                            const Environment& environment,
                                                            const ImportanceSettings& settings,
                                                            const VectorView<float>& out,
                                                            const RunOptions& options = {});

}  // namespace obscura

#endif  // OBSCURA_IMPORTANCE_H_
