#include <algorithm>
#include <cmath>
#include <new>
#include <numbers>

#include "core/aligned_image.h"
#include "core/progress.h"
#include "core/run_threads.h"
#include "core/text.h"
#include "lighting/check_rotation.h"
#include "lighting/light_kernel.h"
#include "lighting/preconvolved_impl.h"
#include "obscura/lighting.h"

namespace obscura {
namespace {

using View = ImageView<const float>;

// Checks that views are there and of the same size.
class SizeCheck {
 public:
  SizeCheck(int width, int height) : width_(width), height_(height) {}

  void image(const View& v, const char* name) {
    if (!status_.ok()) return;
    if (v.empty()) {
      status_ = invalid_argument(text(name, " is missing"));
    } else if (v.width != width_ || v.height != height_) {
      status_ = invalid_argument(text(name, " is ", v.width, "x", v.height, "; it must be ", width_,
                                      "x", height_, ", the size of visibility"));
    }
  }
  void vector(const VectorView<const float>& v, const char* name) {
    image(v.x, name), image(v.y, name), image(v.z, name);
  }
  const Status& status() const { return status_; }

 private:
  const int width_, height_;
  Status status_;
};

// Copies rows of any stride to and from the padded memory of one worker.
class Rows {
 public:
  Rows(int width, int count) : width_(width), memory_(width, count) {}
  float* row(int k) { return memory_.row(k); }
  const float* read(int k, const View& view, int y) {
    float* to = row(k);
    for (int x = 0; x < width_; ++x) to[x] = view(x, y);
    return to;
  }
  void write(int k, const ImageView<float>& view, int y) {
    const float* from = row(k);
    for (int x = 0; x < width_; ++x) view(x, y) = from[x];
  }

 private:
  int width_;
  AlignedImage<float> memory_;
};

// body(rows, y) for each row of an image, on threads.
Status for_rows(int width, int height, int scratch_rows, const RunOptions& options,
                FunctionRef<void(Rows&, int)> body) {
  const RunThreads threads(options);
  if (!threads.status().ok()) return threads.status();
  Executor& executor = threads.executor();
  std::vector<Rows> scratch;
  scratch.reserve(executor.thread_count());
  for (int k = 0; k < executor.thread_count(); ++k) scratch.emplace_back(width, scratch_rows);
  Progress progress(height, options.progress);
  executor.parallel_for(height, [&](int y, int worker) {
    if (progress.cancelled()) return;
    body(scratch[worker], y);
    progress.advance();
  });
  if (progress.cancelled()) return {StatusCode::kCancelled, "lighting was stopped"};
  return {};
}

lighting::LightFrame make_frame(const PreconvolvedEnvironment::Impl& environment,
                                const LightingSettings& s) {
  lighting::LightFrame f;
  f.technique = s.technique;
  f.geometric_term = s.geometric_term;
  f.paper_normalisation = s.normalisation == ConeNormalisation::kPaper;
  f.uniform_weights = s.weights == VisibilityWeights::kUniform;
  f.table = environment.table.data();
  f.cells = environment.grid.cells;
  std::copy(s.world_from_eye.begin(), s.world_from_eye.end(), f.world_from_eye);
  f.sun_shines = environment.sun.shines();
  f.sun = lighting::make_eye_sun(s.world_from_eye, environment.sun);
  return f;
}

}  // namespace

lighting::EyeSun lighting::make_eye_sun(const std::array<float, 9>& world_from_eye,
                                        const Sun& sun) {
  EyeSun eye;
  for (int k = 0; k < 3; ++k) {
    for (int i = 0; i < 3; ++i) eye.direction[k] += world_from_eye[3 * i + k] * sun.direction[i];
    eye.rgb[k] = sun.irradiance[k] / std::numbers::pi_v<float>;
  }
  // Avoids a division by zero for a disc of size 0.
  eye.radius = std::max(sun.angular_radius, 1e-4f);
  return eye;
}

Status light(const LightingInputs& in, const PreconvolvedEnvironment& environment,
             const LightingSettings& settings, const VectorView<float>& out,
             const RunOptions& options) {
  if (environment.empty()) return invalid_argument("the environment is empty");
  if (Status s = validate_ranges(settings); !s.ok()) return s;
  if (Status s = lighting::check_rotation(settings.world_from_eye); !s.ok()) return s;
  const bool bent = settings.technique != LightingTechnique::kAmbientOcclusion;
  const bool cone = settings.technique == LightingTechnique::kBentCone;
  const int width = in.visibility.width, height = in.visibility.height;
  SizeCheck check(width, height);
  check.image(in.visibility, "visibility");
  check.vector(in.normal, "normal");
  if (bent) check.vector(in.bent_normal, "bent-normal");
  if (cone) check.image(in.cone_angle, "cone-angle");
  if (!in.albedo.empty()) check.vector(in.albedo, "albedo");
  check.vector(out, "out");
  if (!check.status().ok()) return check.status();

  try {
    const lighting::LightFrame frame = make_frame(*environment.impl(), settings);
    return for_rows(width, height, 14, options, [&](Rows& rows, int y) {
      lighting::LightRow row;
      row.visibility = rows.read(0, in.visibility, y);
      auto read_vector = [&](int first, const VectorView<const float>& v, const float** to) {
        to[0] = rows.read(first, v.x, y);
        to[1] = rows.read(first + 1, v.y, y);
        to[2] = rows.read(first + 2, v.z, y);
      };
      read_vector(1, in.normal, row.normal);
      if (bent) read_vector(4, in.bent_normal, row.bent);
      if (cone) row.angle = rows.read(7, in.cone_angle, y);
      if (!in.albedo.empty()) read_vector(8, in.albedo, row.albedo);
      for (int c = 0; c < 3; ++c) row.out[c] = rows.row(11 + c);
      lighting::light_row(frame, row, width);
      rows.write(11, out.x, y), rows.write(12, out.y, y), rows.write(13, out.z, y);
    });
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while lighting"};
  }
}

Status cones_from_cosine_integral(const View& visibility,
                                  const VectorView<const float>& cosine_integral,
                                  const VectorView<float>& bent_normal,
                                  const ImageView<float>& cone_angle, const RunOptions& options) {
  const int width = visibility.width, height = visibility.height;
  SizeCheck check(width, height);
  check.image(visibility, "visibility");
  check.vector(cosine_integral, "cosine-integral");
  check.vector(bent_normal, "bent-normal");
  check.image(cone_angle, "cone-angle");
  if (!check.status().ok()) return check.status();
  try {
    return for_rows(width, height, 8, options, [&](Rows& rows, int y) {
      const float* whole = rows.read(0, visibility, y);
      const float* integral[3] = {rows.read(1, cosine_integral.x, y),
                                  rows.read(2, cosine_integral.y, y),
                                  rows.read(3, cosine_integral.z, y)};
      float* direction[3] = {rows.row(4), rows.row(5), rows.row(6)};
      lighting::cosine_cone_row(whole, integral, width, direction, rows.row(7));
      rows.write(4, bent_normal.x, y), rows.write(5, bent_normal.y, y);
      rows.write(6, bent_normal.z, y), rows.write(7, cone_angle, y);
    });
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while making cones"};
  }
}

}  // namespace obscura
