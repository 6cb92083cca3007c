#ifndef OBSCURA_SRC_SCREEN_METHOD_H_
#define OBSCURA_SRC_SCREEN_METHOD_H_

#include <memory>

#include "core/pass_timer.h"
#include "core/progress.h"
#include "obscura/outputs.h"
#include "obscura/run_options.h"
#include "obscura/status.h"
#include "view/geometry.h"

namespace obscura {

// What a method can write beside visibility.
struct OutputKinds {
  bool bent_normal = false;
  bool cone_angle = false;
  bool uniform_integral = false;
  bool cosine_integral = false;
  bool standard_error = false;
  bool radiance = false;
};

struct RunContext {
  Executor& executor;
  const std::function<bool(double)>& progress;
  PassTimer timer{};
};

// A screen-space estimator behind the public Estimator, which checks sizes and outputs, converts
// the input and fills the background, so that a method meets valid data only.
class Method {
 public:
  virtual ~Method() = default;

  virtual view::Needs needs() const = 0;
  virtual OutputKinds output_kinds() const { return {}; }

  // Writes each non-empty output for every visible pixel with finite depth; what it writes to
  // background pixels does not count.
  virtual Status run(const view::Geometry& geometry, const Outputs& outputs,
                     const RunContext& context) = 0;
};

// Makes a method for depth images of up to `width` x `height`, or refuses its settings. The cpu.cpp
// of each method holds the specialisation for its settings.
template <class Settings>
Status make_method(const Settings& settings, int width, int height,
                   std::unique_ptr<Method>* method);

}  // namespace obscura

#endif  // OBSCURA_SRC_SCREEN_METHOD_H_
