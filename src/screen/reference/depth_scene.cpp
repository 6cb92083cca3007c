#include "screen/reference/depth_scene.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace obscura {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();
// Narrow images are padded to at most so many cells, as a power of two.
constexpr int kPaddedLogSize = 22;

// Heights are 1/depth, or -depth of a parallel camera, whose background lies a thousand extents
// behind the farthest surface.
struct HeightOf {
  explicit HeightOf(const view::Geometry& g) : orthographic(g.camera.orthographic) {
    const float extent =
        std::max({static_cast<float>(g.width) * g.camera.scale_x,
                  static_cast<float>(g.height) * g.camera.scale_y, g.max_depth - g.min_depth});
    background = orthographic ? -(g.max_depth + 1000 * extent) : 0.0f;
  }
  float operator()(float depth) const {
    if (depth == kInf) return background;
    return orthographic ? -depth : 1 / depth;
  }
  bool orthographic;
  float background;
};

struct Greater {
  float operator()(float a, float b) const { return std::max(a, b); }
};
struct Less {
  float operator()(float a, float b) const { return std::min(a, b); }
};

}  // namespace

float* DepthScene::level(int pyramid, int l) {
  return pyramids_[pyramid].data() + (std::size_t{1} << (scene_.log_x + scene_.log_y - 2 * l));
}

void DepthScene::size_pyramids(int count) {
  auto log_of = [](int cells) {
    return std::max(1, static_cast<int>(std::bit_width(static_cast<unsigned>(cells - 1))));
  };
  scene_.log_x = log_of(std::max(1, scene_.cells_x));
  scene_.log_y = log_of(std::max(1, scene_.cells_y));
  // Blocks grow until they are as wide as the shorter side: that of a narrow image is taken as
  // longer, or a ray would go along it in small steps.
  int& shorter = scene_.log_x < scene_.log_y ? scene_.log_x : scene_.log_y;
  const int longer = std::max(scene_.log_x, scene_.log_y);
  while (shorter < longer - 2 && shorter + longer < kPaddedLogSize) ++shorter;
  scene_.top_level = std::min(scene_.log_x, scene_.log_y);
  const int log_size = scene_.log_x + scene_.log_y;
  pyramids_.resize(count);
  for (AlignedImage<float>& pyramid : pyramids_) {
    // Level 1 ends where level 0 would begin.
    pyramid.resize(1 << std::min(log_size - 1, 16), 1 << std::max(0, log_size - 17));
    pyramid.data()[0] = 0;  // stands in for blocks that are not asked about
  }
}

// Makes levels 2 and above from level 1, which is filled for whole blocks of cells.
template <class Choose>
void DepthScene::build_upper_levels(int pyramid, Choose choose, Executor& executor) {
  for (int l = 2; l <= scene_.top_level; ++l) {
    const int width = 1 << (scene_.log_x - l), height = 1 << (scene_.log_y - l);
    const float* finer = level(pyramid, l - 1);
    float* coarse = level(pyramid, l);
    executor.parallel_for(height, [&](int y, int) {
      const float* a = finer + std::size_t{4} * y * width;
      const float* b = a + 2 * width;
      float* out = coarse + std::size_t{1} * y * width;
      for (int x = 0; x < width; ++x) {
        out[x] = choose(choose(a[2 * x], a[2 * x + 1]), choose(b[2 * x], b[2 * x + 1]));
      }
    });
  }
}

void DepthScene::build_surface(const view::Geometry& g, Executor& executor) {
  const HeightOf height_of(g);
  heights_.resize(g.width, g.height);
  executor.parallel_for(g.height, [&](int y, int) {
    const float* depth = g.depth.row(y);
    float* out = heights_.row(y);
    for (int x = 0; x < g.width; ++x) out[x] = height_of(depth[x]);
  });
  scene_.stride = heights_.stride();
  scene_.heights = heights_.row(scene_.middle);

  // Level 1: two by two cells, three by three texel centres.
  const int width = 1 << (scene_.log_x - 1), height = 1 << (scene_.log_y - 1);
  float* out = level(0, 1);
  executor.parallel_for(height, [&](int y, int) {
    float* row = out + std::size_t{1} * y * width;
    std::fill_n(row, width, -kInf);
    for (int j = 2 * y; j <= std::min(2 * y + 2, g.height - 1); ++j) {
      const float* in = heights_.row(j);
      for (int x = 0; x < width && 2 * x < g.width; ++x) {
        for (int i = 2 * x; i <= std::min(2 * x + 2, g.width - 1); ++i) {
          row[x] = std::max(row[x], in[i]);
        }
      }
    }
  });
  build_upper_levels(0, Greater(), executor);
  scene_.highest = pyramids_[0].data();
  scene_.max_height = g.max_depth > 0 ? height_of(g.min_depth) : -kInf;
}

void DepthScene::build_boxes(const view::Geometry& g, const Occluder& occluder,
                             Executor& executor) {
  scene_.stride = g.depth.stride();
  const std::ptrdiff_t middle = scene_.middle * scene_.stride;
  if (occluder.kind == OccluderKind::kThickness) {
    back_.resize(g.width, g.height);
    executor.parallel_for(g.height, [&](int y, int) {
      const float b = g.camera.orthographic ? 0 : (g.camera.center_v - y - 0.5f) * g.camera.scale_y;
      for (int x = 0; x < g.width; ++x) {
        const float a =
            g.camera.orthographic ? 0 : (x + 0.5f - g.camera.center_u) * g.camera.scale_x;
        // A length along the view ray; its depth is shorter by the cosine of the ray's angle.
        back_(x, y) = g.depth(x, y) + occluder.thickness / std::sqrt(1 + a * a + b * b);
      }
    });
    scene_.layers = {{g.depth.data() + middle, back_.data() + middle}};
  } else if (g.layers.empty()) {
    scene_.layers = {{g.depth.data() + middle, g.back_depth.data() + middle}};
  } else {
    scene_.layers.clear();
    for (const view::Geometry::Layer& layer : g.layers) {
      scene_.layers.push_back({layer.front.data() + middle, layer.back.data() + middle});
    }
  }

  size_pyramids(2 * static_cast<int>(scene_.layers.size()));
  scene_.max_height = -kInf;
  for (int i = 0; i < static_cast<int>(scene_.layers.size()); ++i) build_bounds(g, i, executor);
}

// The pyramids of one layer, whose level 1 holds blocks of two by two texels.
void DepthScene::build_bounds(const view::Geometry& g, int index, Executor& executor) {
  MatterLayer& layer = scene_.layers[index];
  const HeightOf height_of(g);
  const int width = 1 << (scene_.log_x - 1), height = 1 << (scene_.log_y - 1);
  float* highest = level(2 * index, 1);
  float* lowest = level(2 * index + 1, 1);
  executor.parallel_for(height, [&](int y, int) {
    float* hi = highest + std::size_t{1} * y * width;
    float* lo = lowest + std::size_t{1} * y * width;
    std::fill_n(hi, width, -kInf);
    std::fill_n(lo, width, kInf);
    for (int j = 2 * y; j < std::min(2 * y + 2, g.height); ++j) {
      const float* front = layer.front + (j - scene_.middle) * scene_.stride;
      const float* back = layer.back + (j - scene_.middle) * scene_.stride;
      for (int i = 0; i < g.width; ++i) {
        if (front[i] == kInf) continue;
        const bool endless = back[i] == kInf && height_of.orthographic;
        hi[i / 2] = std::max(hi[i / 2], height_of(front[i]));
        lo[i / 2] = std::min(lo[i / 2], endless ? -kInf : height_of(back[i]));
      }
    }
  });
  const std::size_t blocks = std::size_t{1} * width * height;
  scene_.max_height = std::max(scene_.max_height, *std::max_element(highest, highest + blocks));
  build_upper_levels(2 * index, Greater(), executor);
  build_upper_levels(2 * index + 1, Less(), executor);
  layer.highest = pyramids_[2 * index].data();
  layer.lowest = pyramids_[2 * index + 1].data();
}

void DepthScene::build(const view::Geometry& g, const Occluder& occluder, Executor& executor) {
  scene_.boxes = occluder.kind != OccluderKind::kSolid;
  scene_.orthographic = g.camera.orthographic;
  scene_.scale_x = g.camera.scale_x;
  scene_.scale_y = g.camera.scale_y;
  scene_.cells_x = scene_.boxes ? g.width : g.width - 1;
  scene_.cells_y = scene_.boxes ? g.height : g.height - 1;
  scene_.middle = g.height / 2;
  if (scene_.boxes) {
    build_boxes(g, occluder, executor);
  } else {
    size_pyramids(1);
    build_surface(g, executor);
  }
}

}  // namespace obscura
