#include "obscura/estimator.h"

#include <atomic>
#include <cmath>
#include <new>

#include "core/run_threads.h"
#include "core/text.h"
#include "screen/half_resolution/half_resolution.h"
#include "screen/method.h"
#include "view/half.h"

namespace obscura {
namespace {

template <class Settings>
Status make_any(const Settings& s, int w, int h, std::unique_ptr<Method>* m) {
  if constexpr (requires { s.resolution; }) {
    if (s.resolution == Resolution::kHalf) {
      if (Status status = make_method(s, view::half_of(w), view::half_of(h), m); !status.ok())
        return status;
      *m = make_half_resolution(std::move(*m));
      return {};
    }
  }
  return make_method(s, w, h, m);
}

template <class T>
Status check_output(const ImageView<T>& view, const DepthField& field, bool offered,
                    const char* name) {
  if (view.empty()) return {};
  if (!offered) return unsupported(text("this method does not give ", name));
  if (view.width == field.visible().width && view.height == field.visible().height) return {};
  return invalid_argument(text("output ", name, " is ", view.width, "x", view.height,
                               "; it must be ", field.visible().width, "x", field.visible().height,
                               ", the visible size"));
}

Status check_outputs(const Outputs& o, const DepthField& field, const OutputKinds& kinds) {
  Status status;
  auto check = [&](const ImageView<float>& view, bool offered, const char* name) {
    if (status.ok()) status = check_output(view, field, offered, name);
  };
  auto check_vector = [&](const VectorView<float>& v, bool offered, const char* name) {
    if (v.empty()) return;
    for (const auto* view : {&v.x, &v.y, &v.z}) {
      if (status.ok() && view->empty()) {
        status = invalid_argument(text("output ", name, " lacks a channel"));
      }
      check(*view, offered, name);
    }
  };
  check(o.visibility, true, "visibility");
  check_vector(o.bent_normal, kinds.bent_normal, "bent-normal");
  check(o.cone_angle, kinds.cone_angle, "cone-angle");
  check_vector(o.uniform_integral, kinds.uniform_integral, "uniform-integral");
  check_vector(o.cosine_integral, kinds.cosine_integral, "cosine-integral");
  check(o.standard_error, kinds.standard_error, "standard-error");
  check_vector(o.radiance, kinds.radiance, "radiance");
  check_vector(o.normal, true, "normal");
  if (status.ok() && !o.normal.empty() && field.normal_use == NormalUse::kNone) {
    status = invalid_argument("output normal is asked for, but normal_use is none");
  }
  return status;
}

// Background pixels are not receivers: visibility 1, an open cone towards the camera.
void fill_background(const view::Geometry& g, const Outputs& o, Executor& executor) {
  executor.parallel_for(g.visible().height, [&](int y, int) {
    const float* depth = g.depth.row(y + g.guard_band.top) + g.guard_band.left;
    auto set = [y](const ImageView<float>& view, int x, float value) {
      if (!view.empty()) view(x, y) = value;
    };
    auto set_vector = [&](const VectorView<float>& v, int x, float length) {
      set(v.x, x, 0);
      set(v.y, x, 0);
      set(v.z, x, length);
    };
    for (int x = 0; x < g.visible().width; ++x) {
      if (std::isfinite(depth[x])) continue;
      set(o.visibility, x, 1);
      set_vector(o.bent_normal, x, 1);
      set(o.cone_angle, x, 1.57079633f);
      set_vector(o.uniform_integral, x, 1);
      set_vector(o.cosine_integral, x, 2.0f / 3);
      set_vector(o.radiance, x, 0);
      set(o.standard_error, x, 0);
    }
  });
}

void copy_normals(const view::Geometry& g, const VectorView<float>& out, Executor& executor) {
  executor.parallel_for(g.visible().height, [&](int y, int) {
    const int row = g.guard_band.top + y, left = g.guard_band.left;
    for (int x = 0; x < g.visible().width; ++x) {
      out.x(x, y) = g.normal_x(left + x, row);
      out.y(x, y) = g.normal_y(left + x, row);
      out.z(x, y) = g.normal_z(left + x, row);
    }
  });
}

}  // namespace

class EstimatorImpl {
 public:
  EstimatorImpl(std::unique_ptr<Method> method, int width, int height)
      : method_(std::move(method)), width_(width), height_(height) {}

  Status run(const DepthField& field, const Outputs& outputs, const RunOptions& options) {
    if (running_.exchange(true)) {
      return invalid_argument(
          "this estimator is running already; two runs at once need two objects");
    }
    const Running running{&running_};
    return run_alone(field, outputs, options);
  }

 private:
  // Says that the run has ended, however it ends.
  struct Running {
    std::atomic<bool>* flag;
    ~Running() { flag->store(false); }
  };

  Status run_alone(const DepthField& field, const Outputs& outputs, const RunOptions& options) {
    if (field.depth.width != width_ || field.depth.height != height_) {
      return invalid_input(text("depth is ", field.depth.width, "x", field.depth.height,
                                "; this estimator was created for ", width_, "x", height_));
    }
    threads_.set(options);
    if (!threads_.status().ok()) return threads_.status();
    Executor& executor = threads_.executor();
    view::Needs needs = method_->needs();
    needs.normals = needs.normals || !outputs.normal.empty();
    const PassTimer timer(options.pass_times);
    Status status;
    timer.time("convert", [&] { status = view::convert(field, needs, executor, &geometry_); });
    if (!status.ok()) return status;
    if (Status s = check_outputs(outputs, field, method_->output_kinds()); !s.ok()) return s;
    const RunContext context{executor, options.progress, timer};
    if (Status s = method_->run(geometry_, outputs, context); !s.ok()) return s;
    timer.time("background", [&] { fill_background(geometry_, outputs, executor); });
    if (!outputs.normal.empty()) copy_normals(geometry_, outputs.normal, executor);
    return {};
  }

  std::atomic<bool> running_ = false;
  std::unique_ptr<Method> method_;
  const int width_, height_;
  RunThreads threads_;
  view::Geometry geometry_;
};

Estimator::Estimator() = default;
Estimator::~Estimator() = default;
Estimator::Estimator(Estimator&&) noexcept = default;
Estimator& Estimator::operator=(Estimator&&) noexcept = default;

Status Estimator::create(const MethodSettings& settings, int width, int height,
                         Estimator* estimator) {
  if (!estimator) return invalid_argument("estimator is null; it must point to an Estimator");
  if (width < 1 || height < 1 || width > 65535 || height > 65535) {
    return invalid_argument(
        text("image size is ", width, "x", height, "; each side must be in [1, 65535]"));
  }
  try {
    std::unique_ptr<Method> method;
    Status status =
        std::visit([&](const auto& s) { return make_any(s, width, height, &method); }, settings);
    if (!status.ok()) return status;
    estimator->impl_ = std::make_unique<EstimatorImpl>(std::move(method), width, height);
    return {};
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while creating the estimator"};
  }
}

Status Estimator::run(const DepthField& field, const Outputs& outputs, const RunOptions& options) {
  if (!impl_) return invalid_argument("the estimator has not been created");
  try {
    return impl_->run(field, outputs, options);
  } catch (const std::bad_alloc&) {
    return {StatusCode::kOutOfMemory, "out of memory while running the estimator"};
  }
}

Status compute(const DepthField& field, const MethodSettings& settings, const Outputs& outputs,
               const RunOptions& options) {
  Estimator estimator;
  Status status = Estimator::create(settings, field.depth.width, field.depth.height, &estimator);
  return status.ok() ? estimator.run(field, outputs, options) : status;
}

}  // namespace obscura
