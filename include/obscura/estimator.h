#ifndef OBSCURA_ESTIMATOR_H_
#define OBSCURA_ESTIMATOR_H_

#include <memory>

#include "obscura/depth_field.h"
#include "obscura/export.h"
#include "obscura/methods.h"
#include "obscura/outputs.h"
#include "obscura/run_options.h"
#include "obscura/status.h"

namespace obscura {

class EstimatorImpl;

// A method with fixed settings and image size, for many frames: everything that can be made once
// (patterns, tables, scratch memory) is made by create(); threads are made by the first run() that
// asks for so many, and further ones allocate nothing. An object runs once at a time: a second
// run() while one is under way is refused.
class OBSCURA_API Estimator {
 public:
  Estimator();
  ~Estimator();
  Estimator(Estimator&&) noexcept;
  Estimator& operator=(Estimator&&) noexcept;

  // `width` x `height` is the depth image with its guard band.
  static Status create(const MethodSettings& settings, int width, int height, Estimator* estimator);

  // Computes the outputs whose views are not empty. `field.depth` has the size given to create().
  Status run(const DepthField& field, const Outputs& outputs, const RunOptions& options = {});

 private:
  std::unique_ptr<EstimatorImpl> impl_;
};

// One call for arrays: create and run.
OBSCURA_API Status compute(const DepthField& field, const MethodSettings& settings,
                           const Outputs& outputs, const RunOptions& options = {});

}  // namespace obscura

#endif  // OBSCURA_ESTIMATOR_H_
