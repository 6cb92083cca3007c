#ifndef OBSCURA_ESTIMATOR_H_
#define OBSCURA_ESTIMATOR_H_

#include <memory>
#include <variant>

#include "obscura/area.h"
#include "obscura/depth_field.h"
#include "obscura/far_field.h"
#include "obscura/hemisphere.h"
#include "obscura/horizon.h"
#include "obscura/line.h"
#include "obscura/mipmap.h"
#include "obscura/outputs.h"
#include "obscura/point.h"
#include "obscura/reference.h"
#include "obscura/status.h"

namespace obscura {

// One alternative per method; docs/settings.md lists their fields.
using MethodSettings =
    std::variant<AreaSettings, FarFieldSettings, HemisphereSettings, HorizonSettings, LineSettings,
                 MipmapSettings, PointSettings, ReferenceSettings>;

class EstimatorImpl;

// A method with fixed settings and image size, for many frames: everything that can be made once
// (patterns, tables, scratch memory, threads) is made by create(), and run() allocates nothing.
// run() is not to be called from two threads at once on one object.
class Estimator {
 public:
  Estimator();
  ~Estimator();
  Estimator(Estimator&&) noexcept;
  Estimator& operator=(Estimator&&) noexcept;

  // `width` x `height` is the depth image with its guard band; `threads` as for make_executor.
  static Status create(const MethodSettings& settings, int width, int height, int threads,
                       Estimator* estimator);

  // Computes the outputs whose views are not empty. `field.depth` has the size given to create().
  Status run(const DepthField& field, const Outputs& outputs, const RunOptions& options = {});

 private:
  std::unique_ptr<EstimatorImpl> impl_;
};

// One call for arrays: create and run, on every processor unless options.executor says otherwise.
Status compute(const DepthField& field, const MethodSettings& settings, const Outputs& outputs,
               const RunOptions& options = {});

}  // namespace obscura

#endif  // OBSCURA_ESTIMATOR_H_
