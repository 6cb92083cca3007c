#include "volume/visibility_field.h"

#include <algorithm>

#include "core/guarded.h"
#include "core/run_threads.h"
#include "core/text.h"

namespace obscura {

VisibilityField::VisibilityField() : impl_(std::make_unique<VisibilityFieldImpl>()) {}
VisibilityField::~VisibilityField() = default;
VisibilityField::VisibilityField(VisibilityField&&) noexcept = default;
VisibilityField& VisibilityField::operator=(VisibilityField&&) noexcept = default;

bool VisibilityField::empty() const { return !impl_ || impl_->scheme.directions.empty(); }
std::array<int, 3> VisibilityField::size() const { return impl_->size; }
std::array<float, 3> VisibilityField::spacing() const { return impl_->spacing; }
std::array<float, 3> VisibilityField::origin() const { return impl_->origin; }
std::size_t VisibilityField::bytes() const {
  std::size_t sum = 0;
  for (int half = 0; half < 2; ++half) {
    if (impl_->bytes[half]) sum += impl_->voxels() * impl_->channels();
    if (impl_->floats[half]) sum += impl_->voxels() * impl_->channels() * sizeof(float);
  }
  return sum;
}

Status VisibilityField::octant(int octant, GridView<float> visibility) const {
  if (empty()) return invalid_input("the visibility field is empty; sweep it first");
  const VisibilityFieldImpl& f = *impl_;
  if (octant < 0 || octant > 7 || !f.has_half(octant >> 2)) {
    return invalid_argument(text("octant is ", octant, "; it must be in [0, 7], of a shadow 7"));
  }
  if (visibility.data == nullptr || visibility.size != f.size) {
    return invalid_input(text("visibility must be a grid of ", f.size[0], "x", f.size[1], "x",
                              f.size[2], " samples, as the field's own"));
  }
  const auto stride = visibility.strides();
  const int n = f.directions();
  float values[4 * kMaxDirections];
  std::size_t voxel = 0;
  for (int z = 0; z < f.size[2]; ++z) {
    for (int y = 0; y < f.size[1]; ++y) {
      for (int x = 0; x < f.size[0]; ++x, ++voxel) {
        std::fill_n(values, f.channels(), 0.0f);
        f.add(octant >> 2, voxel, 1, values);
        float mean = 0;
        for (int i = 0; i < n; ++i) {
          mean += f.scheme.directions[i].weight * values[f.first_channel(octant) + i];
        }
        visibility.data[x * stride[0] + y * stride[1] + z * stride[2]] = std::min(mean, 1.0f);
      }
    }
  }
  return {};
}

Status VisibilityField::scalar(GridView<float> visibility, const RunOptions& run) const {
  return guarded("the mean of a visibility field", [&]() -> Status {
    if (empty()) return invalid_input("the visibility field is empty; sweep it first");
    const VisibilityFieldImpl& f = *impl_;
    if (visibility.data == nullptr || visibility.size != f.size) {
      return invalid_input(text("visibility must be a grid of ", f.size[0], "x", f.size[1], "x",
                                f.size[2], " samples, as the field's own"));
    }
    const RunThreads threads(run);
    if (!threads.status().ok()) return threads.status();
    Executor& executor = threads.executor();
    const int n = static_cast<int>(f.channels());
    float weight[2][4 * kMaxDirections] = {};
    for (int s = f.shadow ? static_cast<int>(kShadowOctant) : 0; s < 8; ++s) {
      for (int i = 0; i < f.directions(); ++i) {
        weight[s >> 2][f.first_channel(s) + i] =
            f.scheme.directions[i].weight * (f.shadow ? 1.0f : 0.125f);
      }
    }
    const auto stride = visibility.strides();
    executor.parallel_for(f.size[2], [&](int z, int) {
      std::size_t voxel = static_cast<std::size_t>(z) * f.size[0] * f.size[1];
      for (int y = 0; y < f.size[1]; ++y) {
        float* out = visibility.data + z * stride[2] + y * stride[1];
        for (int x = 0; x < f.size[0]; ++x, ++voxel) {
          float sum = 0;
          for (int half = 0; half < 2; ++half) {
            const std::size_t at = voxel * f.channels();
            if (f.bytes[half]) {
              const std::uint8_t* v = f.bytes[half].get() + at;
              float bytes = 0;
              for (int c = 0; c < n; ++c) bytes += weight[half][c] * static_cast<float>(v[c]);
              sum += bytes * (1.0f / 255);
            } else if (f.floats[half]) {
              const float* v = f.floats[half].get() + at;
              for (int c = 0; c < n; ++c) sum += weight[half][c] * v[c];
            }
          }
          out[x * stride[0]] = std::min(sum, 1.0f);
        }
      }
    });
    return {};
  });
}

}  // namespace obscura
