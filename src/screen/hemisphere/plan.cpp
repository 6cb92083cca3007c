#include "screen/hemisphere/plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/check_sphere.h"
#include "core/random.h"

namespace obscura {
namespace {

// The directions' azimuths advance by the golden angle; each pixel of the tile turns them by its
// own part of the circle and shifts them by its own parts of a stratum and of a step.
void set_pattern(const HemisphereSettings& s, hemisphere::Frame* f) {
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < s.samples; ++i) {
    f->cosine[i] = static_cast<float>(std::cos(golden * i));
    f->sine[i] = static_cast<float>(std::sin(golden * i));
    f->offset[i] = static_cast<float>(std::fmod(i * 0.75487766624669276, 1.0));
  }
  const int m = s.interleave, cells = m * m;
  Random random(s.seed);
  const std::vector<int> turns = shuffled(cells, &random), shifts = shuffled(cells, &random);
  const std::vector<int> offsets = shuffled(cells, &random);
  for (int cell = 0; cell < cells; ++cell) {
    const double turn = 2 * std::numbers::pi * (turns[cell] + 0.5) / cells;
    const double shift = (shifts[cell] + 0.5) / cells;
    double values[hemisphere::kTileValues] = {};
    values[hemisphere::kTileCos] = std::cos(turn);
    values[hemisphere::kTileSin] = std::sin(turn);
    values[hemisphere::kTileShift] = shift;
    values[hemisphere::kTileOffset] = (offsets[cell] + 0.5) / cells;
    double cosine_sum = 0;
    for (int i = 0; i < s.samples; ++i) {
      const double z = 1 - (i + shift) / s.samples, r = std::sqrt(1 - z * z);
      const double w[3] = {r * std::cos(golden * i + turn), r * std::sin(golden * i + turn), z};
      cosine_sum += z;
      for (int k = 0; k < 3; ++k) {
        values[hemisphere::kTileMean + k] += w[k] / s.samples;
        values[hemisphere::kTileCosineMean + k] += w[k] * z;
      }
    }
    for (int k = 0; k < 3; ++k) values[hemisphere::kTileCosineMean + k] /= cosine_sum;
    values[hemisphere::kTileCosineSum] = cosine_sum;
    for (int v = 0; v < hemisphere::kTileValues; ++v) {
      for (int x = cell % m; x < hemisphere::kTileRow; x += m) {
        f->tile[v][cell / m][x] = static_cast<float>(values[v]);
      }
    }
  }
}

}  // namespace

Status make_plan(const HemisphereSettings& settings, hemisphere::Frame* f) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = check_sphere(settings.falloff, "hemisphere"); !s.ok()) return s;
  if (Status s = validate(settings.occluder); !s.ok()) return s;
  if (settings.occluder.kind == OccluderKind::kLayers) {
    return unsupported("hemisphere takes the occluders auto, solid, thickness and back-depth");
  }
  f->radius = std::clamp(settings.falloff.radius, 1e-30f, 1e30f);
  f->quadratic = settings.falloff.kind == FalloffKind::kQuadratic;
  f->matter = view::matter_of(settings.occluder);
  f->thickness = settings.occluder.thickness;
  f->samples = settings.samples;
  f->tests = settings.steps + 1;
  f->interleave = settings.interleave;
  set_pattern(settings, f);
  return {};
}

}  // namespace obscura
