#include <algorithm>

#include "screen/far_field/share_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/share_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {
namespace leaf {
#include "screen/far_field/share_leaf.h"
}  // namespace leaf
}  // namespace HWY_NAMESPACE

namespace far_field::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace leaf = obscura::HWY_NAMESPACE::leaf;
using D = hn::ScalableTag<float>;
using V = hn::Vec<D>;

// The point `column` pixels right of and `row` below pixel i of the job, and where it has depth.
HWY_INLINE leaf::SharePoint PointAt(const ShareJob& job, int i, int row, int column,
                                    hn::Mask<D>* surface) {
  const D d;
  const ShareJob::Row& r = job.rows[row + 1];
  const int at = i + column + 1;
  V z = hn::LoadU(d, r.depth + at);
  *surface = hn::Lt(z, hn::Inf(d));
  z = hn::IfThenElse(*surface, z, hn::Set(d, 1.0f));
  const V along = job.view.parallel ? hn::Set(d, 1.0f) : z;
  const V x = hn::Iota(d, job.axis_x + static_cast<float>(i + column));
  const V y = hn::Set(d, (job.axis_y + static_cast<float>(row)) * job.view.scale_y);
  // The image's y and the third axis run against eye space's.
  return {hn::Mul(hn::Mul(x, hn::Set(d, job.view.scale_x)), along),
          hn::Mul(y, along),
          z,
          hn::LoadU(d, r.normal[0] + at),
          hn::Neg(hn::LoadU(d, r.normal[1] + at)),
          hn::Neg(hn::LoadU(d, r.normal[2] + at))};
}

// In a window of 3 x 3 pixels, those of one share lie alike for every pixel.
template <int kSide>
int ShareOf(int row, int column) {
  return kSide == 2 ? 2 * (row & 1) + (column & 1) : 3 * (row + 1) + column + 1;
}

template <int kSide>
void ShareRow(ShareJob* job) {
  constexpr int kShares = kSide * kSide;
  const D d;
  const V zero = hn::Zero(d);
  const float footprint = std::max(job->view.scale_x, job->view.scale_y);
  for (int i = 0; i < job->count; i += static_cast<int>(hn::Lanes(d))) {
    hn::Mask<D> surface, other_surface;
    const leaf::SharePoint own = PointAt(*job, i, 0, 0, &surface);
    const V along = job->view.parallel ? hn::Set(d, 1.0f) : own.z;
    const V inverse = leaf::leaf_reciprocal(hn::Mul(along, hn::Set(d, footprint)));
    V weight[9], weights[kShares];
    std::fill_n(weights, kShares, zero);
    for (int k = 0; k < 9; ++k) {
      const int row = k / 3 - 1, column = k % 3 - 1;
      const leaf::SharePoint other = PointAt(*job, i, row, column, &other_surface);
      weight[k] = hn::IfThenElseZero(hn::And(surface, other_surface),
                                     leaf::weight_apart(row * row + column * column));
      if (k != 4) weight[k] = hn::Mul(weight[k], leaf::weight_of_surface(own, other, inverse));
      V& sum = weights[ShareOf<kSide>(row, column)];
      sum = hn::Add(sum, weight[k]);
    }
    V certain = zero, certainty[kShares];
    for (int s = 0; s < kShares; ++s) {
      certainty[s] = leaf::share_certainty(weights[s]);
      certain = hn::MulAdd(weights[s], certainty[s], certain);
    }
    const V inverse_certain = hn::IfThenElseZero(
        surface, hn::Div(hn::Set(d, 1.0f), hn::Max(certain, hn::Set(d, 1e-6f))));
    for (int c = 0; c < job->channels; ++c) {
      V total = zero, scale = zero;
      for (int k = 0; k < 9; ++k) {
        const int row = k / 3 - 1, column = k % 3 - 1;
        const V sum = hn::LoadU(d, job->rows[row + 1].sums[c] + i + column + 1);
        total = hn::MulAdd(hn::Mul(weight[k], certainty[ShareOf<kSide>(row, column)]), sum, total);
      }
      // What a share lacks in weight it takes from the mean.
      const V mean = hn::Mul(total, inverse_certain);
      for (int s = 0; s < kShares; ++s) scale = hn::Add(scale, certainty[s]);
      total = hn::MulAdd(hn::Mul(hn::Set(d, leaf::kMeanWeight), scale), mean, total);
      hn::BlendedStore(total, hn::FirstN(d, job->count - i), d, job->out[c] + i);
    }
  }
}

void ShareRowAny(ShareJob* job) { job->side == 2 ? ShareRow<2>(job) : ShareRow<3>(job); }

}  // namespace far_field::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(ShareRowAny);

void share_row(ShareJob* job) { HWY_DYNAMIC_DISPATCH(ShareRowAny)(job); }

}  // namespace obscura::far_field
#endif
