#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfPartType.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <utility>

#include "io/images/exr_native.h"

namespace obscura::tools {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// Sorted by front; those that touch become one.
void merge(std::vector<std::pair<float, float>>* samples) {
  std::sort(samples->begin(), samples->end());
  std::size_t kept = 0;
  for (const auto& s : *samples) {
    if (kept > 0 && s.first <= (*samples)[kept - 1].second) {
      (*samples)[kept - 1].second = std::max((*samples)[kept - 1].second, s.second);
    } else {
      (*samples)[kept++] = s;
    }
  }
  samples->resize(kept);
}

}  // namespace

Status read_exr_deep(const std::string& path, int part, int most_layers,
                     std::vector<DeepLayer>* layers) {
  return guard_exr(path, [&]() -> Status {
    std::unique_ptr<Imf::MultiPartInputFile> file;
    ExrHeader header;
    if (Status s = open_exr(path, &header, &file, part); !s.ok()) return s;
    const Imf::Header& native = file->header(part);
    if (!native.hasType() || native.type() != Imf::DEEPSCANLINE) {
      return invalid_input(
          fmt::format("{}: part {} is a tiled deep image; only scan lines are read", path, part));
    }
    const bool backs = header.find("ZBack") != nullptr;
    const PixelWindow& w = header.data_window;
    const int width = w.width();
    const std::size_t pixels = static_cast<std::size_t>(width) * w.height();
    Imf::DeepScanLineInputPart input(*file, part);
    // Samples are read row by row: a row's counts are known before its memory is taken.
    std::vector<unsigned> counts(width);
    std::vector<float*> at[2] = {std::vector<float*>(width), std::vector<float*>(width)};
    Imf::DeepFrameBuffer frame;
    auto row_origin = [&](void* p, std::ptrdiff_t bytes) {
      return static_cast<char*>(p) - w.min_x * bytes;
    };
    frame.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, row_origin(counts.data(), sizeof(unsigned)), sizeof(unsigned), 0));
    for (int c = 0; c < (backs ? 2 : 1); ++c) {
      frame.insert(c == 0 ? "Z" : "ZBack",
                   Imf::DeepSlice(Imf::FLOAT, row_origin(at[c].data(), sizeof(float*)),
                                  sizeof(float*), 0, sizeof(float)));
    }
    input.setFrameBuffer(frame);
    // Deflated samples are at least a thousandth of their size.
    std::error_code error;
    const auto bytes = static_cast<double>(std::filesystem::file_size(path, error));
    const double most_samples = error ? 0 : 1100 * bytes;
    double all_samples = 0;
    std::vector<DeepLayer> result;
    std::vector<float> values[2];
    std::vector<std::pair<float, float>> samples;
    for (int y = w.min_y; y <= w.max_y; ++y) {
      input.readPixelSampleCounts(y);
      std::size_t row = 0;
      for (const unsigned n : counts) row += n;
      all_samples += static_cast<double>(row);
      if (all_samples > most_samples) {
        return invalid_input(
            fmt::format("{}: damaged: it claims more samples than it can hold", path));
      }
      for (int c = 0; c < 2; ++c) {
        values[c].resize(row + 1);
        float* next = values[c].data();
        for (int x = 0; x < width; ++x) {
          at[c][x] = next;
          next += counts[x];
        }
      }
      input.readPixels(y);
      for (int x = 0; x < width; ++x) {
        samples.clear();
        for (unsigned i = 0; i < counts[x]; ++i) {
          const float front = at[0][x][i], back = backs ? at[1][x][i] : front;
          if (front < kInf) samples.push_back({front, back >= front ? back : front});
        }
        merge(&samples);
        const std::size_t pixel = static_cast<std::size_t>(y - w.min_y) * width + x;
        const std::size_t count =
            std::min(samples.size(), static_cast<std::size_t>(std::max(most_layers, 1)));
        while (result.size() < count) {
          result.push_back({std::vector<float>(pixels, kInf), std::vector<float>(pixels, kInf)});
        }
        for (std::size_t i = 0; i < count; ++i) {
          result[i].front[pixel] = samples[i].first;
          result[i].back[pixel] = samples[i].second;
        }
      }
    }
    *layers = std::move(result);
    return {};
  });
}

}  // namespace obscura::tools
