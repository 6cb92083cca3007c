#include "io/pictures/pictures.h"

#include <algorithm>
#include <cmath>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "stb/stb_easy_font.h"
#pragma GCC diagnostic pop

namespace obscura::tools {
namespace {

constexpr int kTitleHeight = 20, kGap = 4, kTextScale = 1;

float clamp01(float v) { return std::isnan(v) ? 0.0f : std::clamp(v, 0.0f, 1.0f); }

Image rgb(int width, int height, float value = 0) {
  Image image(width, height);
  for (const char* name : {"R", "G", "B"}) {
    std::vector<float>& channel = image.add(name);
    std::fill(channel.begin(), channel.end(), value);
  }
  return image;
}

void put(const Image& from, int x0, int y0, Image* to) {
  for (int c = 0; c < 3; ++c) {
    const auto in = from.view(from.channels.size() == 1 ? 0 : c);
    const auto out = to->view(c);
    for (int y = 0; y < from.height; ++y) {
      for (int x = 0; x < from.width; ++x) out(x0 + x, y0 + y) = clamp01(in(x, y));
    }
  }
}

void draw_text(std::string text, int x0, int y0, int max_width, Image* image) {
  while (!text.empty() && stb_easy_font_width(text.data()) * kTextScale > max_width) {
    text.pop_back();
  }
  // Quads of four vertices {float x, y, z; unsigned char color[4]}.
  struct Vertex {
    float x, y, z;
    unsigned char color[4];
  };
  std::vector<Vertex> vertices(text.size() * 4 * 16 + 64);
  const int quads = stb_easy_font_print(0, 0, text.data(), nullptr, vertices.data(),
                                        static_cast<int>(vertices.size() * sizeof(Vertex)));
  for (int q = 0; q < quads; ++q) {
    const Vertex& a = vertices[4 * q];
    const Vertex& b = vertices[4 * q + 2];
    for (int y = static_cast<int>(a.y); y < static_cast<int>(b.y); ++y) {
      for (int x = static_cast<int>(a.x); x < static_cast<int>(b.x); ++x) {
        if (x0 + x >= image->width || y0 + y >= image->height) continue;
        for (int c = 0; c < 3; ++c) image->view(c)(x0 + x, y0 + y) = 0;
      }
    }
  }
}

}  // namespace

Image grey_picture(const ImageView<const float>& values) {
  Image out(values.width, values.height);
  out.add("Y");
  const auto view = out.view(0);
  for (int y = 0; y < values.height; ++y) {
    for (int x = 0; x < values.width; ++x) view(x, y) = clamp01(values(x, y));
  }
  return out;
}

Image depth_picture(const ImageView<const float>& depth) {
  float lo = INFINITY, hi = 0;
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float d = depth(x, y);
      if (!(d > 0 && d < INFINITY)) continue;
      lo = std::min(lo, d);
      hi = std::max(hi, d);
    }
  }
  Image out(depth.width, depth.height);
  out.add("Y");
  const auto view = out.view(0);
  const float range = std::max(std::log(hi / lo), 1e-6f);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const float d = depth(x, y);
      view(x, y) = d > 0 && d < INFINITY ? 1 - 0.85f * std::log(d / lo) / range : 0.0f;
    }
  }
  return out;
}

Image vector_picture(const VectorView<const float>& vectors) {
  Image out = rgb(vectors.x.width, vectors.x.height);
  const ImageView<const float>* in[] = {&vectors.x, &vectors.y, &vectors.z};
  for (int c = 0; c < 3; ++c) {
    const auto view = out.view(c);
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) view(x, y) = clamp01(0.5f + 0.5f * (*in[c])(x, y));
    }
  }
  return out;
}

Image error_picture(const ImageView<const float>& image, const ImageView<const float>& reference,
                    const ImageView<const float>& mask) {
  Image out = rgb(reference.width, reference.height);
  const int n = std::max(1, image.width / reference.width);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int u = x * n + n / 2, v = y * n + n / 2;
      const float d = std::abs(image(u, v) - reference(x, y));
      const bool known = !std::isnan(d) && (mask.empty() || std::isfinite(mask(u, v)));
      for (int c = 0; c < 3; ++c) {
        const float unknown = c == 2 ? 0.7f : 0.5f;
        out.view(c)(x, y) = known ? clamp01(1 - d / 0.2f) : unknown;
      }
    }
  }
  return out;
}

Image beside(const std::vector<Panel>& panels) {
  int width = 0, height = 0;
  for (const Panel& p : panels) {
    width += p.picture.width + (width > 0 ? kGap : 0);
    height = std::max(height, p.picture.height);
  }
  Image out = rgb(width, height + kTitleHeight, 1);
  int x = 0;
  for (const Panel& p : panels) {
    draw_text(p.title, x + 4, 6, p.picture.width - 8, &out);
    put(p.picture, x, kTitleHeight, &out);
    x += p.picture.width + kGap;
  }
  return out;
}

Image stack(const std::vector<Image>& rows) {
  int width = 0, height = 0;
  for (const Image& r : rows) {
    width = std::max(width, r.width);
    height += r.height;
  }
  Image out = rgb(width, height, 1);
  int y = 0;
  for (const Image& r : rows) {
    put(r, 0, y, &out);
    y += r.height;
  }
  return out;
}

}  // namespace obscura::tools
