#include <algorithm>
#include <cmath>
#include <new>
#include <vector>

#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "lighting/environment_impl.h"
#include "lighting/preconvolved_impl.h"
#include "obscura/lighting.h"

namespace obscura {

using lighting::CubeGrid;
using lighting::kLevels;
using lighting::kVertexFloats;

namespace {

std::vector<lighting::ConvolutionSource> sources_of(const lighting::RadianceMap& map) {
  std::vector<lighting::ConvolutionSource> sources;
  map.grid.for_each([&](CubeGrid::Vertex v) {
    const lighting::RadianceMap::Texel& t = map.texels[map.grid.index(v.face, v.i, v.j)];
    if (t.solid_angle == 0) return;
    const std::array<float, 3> d = map.grid.direction(v);
    const float w = t.solid_angle;
    sources.push_back({d[0], d[1], d[2], w * t.r, w * t.g, w * t.b, w});
  });
  return sources;
}

// A ramp about two source cells wide, so that a source enters a cone smoothly as the direction
// turns. The open cone needs none: its weight, the cosine, ends at zero.
void set_levels(int source_cells, lighting::ConvolutionLevel* levels) {
  const double half_width = 1.0 / source_cells;
  for (int k = 0; k < kLevels - 1; ++k) {
    const double angle = lighting::kLevelStep * (k + 1);
    const double inner = std::cos(std::max(angle - half_width, 0.0));
    const double outer = std::cos(angle + half_width);
    levels[k].slope = static_cast<float>(1 / (inner - outer));
    levels[k].offset = static_cast<float>(-outer / (inner - outer));
  }
  levels[kLevels - 1] = {0, 1};
}

}  // namespace

Status PreconvolvedEnvironment::make(const Environment& environment,
                                     const PreconvolutionSettings& settings,
                                     PreconvolvedEnvironment* result, const RunOptions& options) {
  if (environment.empty()) return invalid_argument("the environment is empty");
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  try {
    auto impl = std::make_shared<Impl>();
    impl->grid = CubeGrid{settings.cells};
    impl->sun = environment.sun();
    const CubeGrid& grid = impl->grid;
    impl->table.resize(static_cast<int>(table_size(settings)), 1);
    float* table = impl->table.data();

    const lighting::RadianceMap& fine = environment.impl()->map;
    const std::vector<lighting::ConvolutionSource> sources = sources_of(
        settings.source_cells < fine.grid.cells ? fine.coarser(CubeGrid{settings.source_cells})
                                                : fine);
    lighting::Convolution convolution{sources.data(), sources.size(), {}};
    set_levels(settings.source_cells, convolution.levels);

    std::vector<CubeGrid::Vertex> owned;
    grid.for_each([&](CubeGrid::Vertex v) {
      if (grid.owns(v)) owned.push_back(v);
    });
    constexpr int kGroup = lighting::kConvolutionGroup;
    const int groups = static_cast<int>((owned.size() + kGroup - 1) / kGroup);

    const RunThreads threads(options);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    Progress progress(groups, options.progress);
    executor.parallel_for(groups, [&](int group, int) {
      if (progress.cancelled()) return;
      const std::size_t first = std::size_t(group) * kGroup;
      const int count = static_cast<int>(std::min<std::size_t>(kGroup, owned.size() - first));
      float x[kGroup] = {}, y[kGroup] = {}, z[kGroup] = {};
      for (int k = 0; k < count; ++k) {
        const std::array<float, 3> d = grid.direction(owned[first + k]);
        x[k] = d[0], y[k] = d[1], z[k] = d[2];
      }
      float out[kGroup * kVertexFloats];
      lighting::convolve(convolution, x, y, z, count, out);
      for (int k = 0; k < count; ++k) {
        const CubeGrid::Vertex v = owned[first + k];
        std::copy_n(out + k * kVertexFloats, kVertexFloats,
                    table + grid.index(v.face, v.i, v.j) * kVertexFloats);
      }
      progress.advance();
    });
    if (progress.cancelled()) return {StatusCode::kCancelled, "pre-convolution was stopped"};

    grid.for_each([&](CubeGrid::Vertex v) {
      const CubeGrid::Vertex o = grid.owner(v);
      if (o.face == v.face) return;
      std::copy_n(table + grid.index(o.face, o.i, o.j) * kVertexFloats, kVertexFloats,
                  table + grid.index(v.face, v.i, v.j) * kVertexFloats);
    });
    result->impl_ = std::move(impl);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while convolving the environment"};
  }
  return {};
}

std::size_t PreconvolvedEnvironment::table_size(const PreconvolutionSettings& settings) {
  return CubeGrid{settings.cells}.vertices() * kVertexFloats;
}

Status PreconvolvedEnvironment::from_table(const PreconvolutionSettings& settings,
                                           std::span<const float> table, const Sun& sun,
                                           PreconvolvedEnvironment* result) {
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (table.size() != table_size(settings)) {
    return invalid_argument(text("table has ", table.size(), " numbers; it must have ",
                                 table_size(settings), " for ", settings.cells, " cells"));
  }
  for (float v : table) {
    if (!(v >= 0 && std::isfinite(v))) {
      return invalid_argument(text("table holds ", v, "; its numbers must be in [0, inf)"));
    }
  }
  Sun checked;
  if (Status s = lighting::check_sun(sun, &checked); !s.ok()) return s;
  try {
    auto impl = std::make_shared<Impl>();
    impl->grid = CubeGrid{settings.cells};
    impl->table.resize(static_cast<int>(table.size()), 1);
    std::copy(table.begin(), table.end(), impl->table.data());
    impl->sun = checked;
    result->impl_ = std::move(impl);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while copying the table"};
  }
  return {};
}

std::span<const float> PreconvolvedEnvironment::table() const {
  return {impl_->table.data(), static_cast<std::size_t>(impl_->table.width())};
}

const Sun& PreconvolvedEnvironment::sun() const { return impl_->sun; }

std::array<float, 3> PreconvolvedEnvironment::radiance(const std::array<float, 3>& direction,
                                                       float cone_angle) const {
  const CubeGrid::Hit h = impl_->grid.hit(direction);
  const auto widest = static_cast<float>(kLevels - 1);
  float level = cone_angle / lighting::kLevelStep - 1;
  level = level < widest ? std::max(level, 0.0f) : widest;  // NaN: the open cone
  const int low = std::min(static_cast<int>(level), kLevels - 2);
  const float between = level - static_cast<float>(low);
  const float* cell = impl_->table.data() + h.index * kVertexFloats + 4 * low;
  const std::ptrdiff_t row = std::ptrdiff_t{kVertexFloats} * impl_->grid.side();
  std::array<float, 3> rgb;
  for (int c = 0; c < 3; ++c) {
    auto bilinear = [&](const float* p) {
      const float top = p[0] + h.u * (p[kVertexFloats] - p[0]);
      const float bottom = p[row] + h.u * (p[row + kVertexFloats] - p[row]);
      return top + h.v * (bottom - top);
    };
    const float low_level = bilinear(cell + c), high_level = bilinear(cell + c + 4);
    rgb[c] = low_level + between * (high_level - low_level);
  }
  return rgb;
}

}  // namespace obscura
