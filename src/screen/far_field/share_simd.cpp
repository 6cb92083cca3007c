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

// What neighbours weigh for the pixels from i on.
struct Weights {
  Weights(const ShareJob& job, int i) {
    const D d;
    hn::Mask<D> other_surface;
    const leaf::SharePoint own = PointAt(job, i, 0, 0, &surface);
    const float footprint = std::max(job.view.scale_x, job.view.scale_y);
    const V inverse = leaf::leaf_reciprocal(
        hn::Mul(job.view.parallel ? hn::Set(d, 1.0f) : own.z, hn::Set(d, footprint)));
    for (int k = 0; k < 9; ++k) {
      const int row = k / 3 - 1, column = k % 3 - 1;
      const leaf::SharePoint other = PointAt(job, i, row, column, &other_surface);
      V w = leaf::weight_of_place(column, row, job.side);
      if (k != 4) w = hn::Mul(w, leaf::weight_of_surface(own, other, inverse));
      of[k] = hn::IfThenElseZero(hn::And(surface, other_surface), w);
    }
  }

  hn::Mask<D> surface;
  V of[9];
};

void ShareRow(ShareJob* job) {
  const D d;
  const V shares = hn::Set(d, static_cast<float>(job->side * job->side));
  for (int i = 0; i < job->count; i += static_cast<int>(hn::Lanes(d))) {
    const Weights w(*job, i);
    V known = hn::Zero(d);
    for (int k = 0; k < 9; ++k) {
      known = hn::MulAdd(w.of[k], hn::LoadU(d, job->rows[k / 3].shares + i + k % 3), known);
    }
    const V scale = hn::IfThenElseZero(w.surface, hn::Div(shares, known));
    for (int c = 0; c < job->channels; ++c) {
      V total = hn::Zero(d);
      for (int k = 0; k < 9; ++k) {
        total = hn::MulAdd(w.of[k], hn::LoadU(d, job->rows[k / 3].sums[c] + i + k % 3), total);
      }
      hn::BlendedStore(hn::Mul(total, scale), hn::FirstN(d, job->count - i), d, job->out[c] + i);
    }
  }
}

void FindKnown(ShareJob* job) {
  const D d;
  const hn::RebindToSigned<D> di;
  for (int i = 0; i < job->count; i += static_cast<int>(hn::Lanes(d))) {
    const Weights w(*job, i);
    V known = hn::Zero(d);
    for (const V& weight : w.of) known = hn::Add(known, weight);
    known = hn::IfThenElse(w.surface, known, hn::Set(d, static_cast<float>(job->side * job->side)));
    const V units =
        hn::MulAdd(known, hn::Set(d, static_cast<float>(leaf::kKnownUnits)), hn::Set(d, 0.5f));
    hn::StoreU(hn::ConvertTo(di, units), di, job->known + i);
  }
}

}  // namespace far_field::HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(ShareRow);
HWY_EXPORT(FindKnown);

void share_row(ShareJob* job) { HWY_DYNAMIC_DISPATCH(ShareRow)(job); }
void find_known(ShareJob* job) { HWY_DYNAMIC_DISPATCH(FindKnown)(job); }

}  // namespace obscura::far_field
#endif
