// The update of a distance from its three upwind neighbours; included once per SIMD target.
#if defined(OBSCURA_SRC_VOLUME_DISTANCE_QUADRATIC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef OBSCURA_SRC_VOLUME_DISTANCE_QUADRATIC_INL_H_
#undef OBSCURA_SRC_VOLUME_DISTANCE_QUADRATIC_INL_H_
#else
#define OBSCURA_SRC_VOLUME_DISTANCE_QUADRATIC_INL_H_
#endif

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace obscura {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;
using M = hn::Mask<D>;

// |grad D| = 1 by one-sided differences, the smallest neighbour subtracted first, which keeps the
// quadratic from cancelling (equation 1). Returns the estimate less `least`.
template <bool kCubic>
class Quadratic;

template <>
class Quadratic<true> {
 public:
  explicit Quadratic(const float spacing[3]) : h_(spacing[0]) {}
  HWY_INLINE V operator()(V a, V b, V c, V least) const {
    const D d;
    const V h = hn::Set(d, h_), h2 = hn::Mul(h, h);
    const V low = hn::Min(a, b), high = hn::Max(a, b);
    const V middle = hn::Max(low, hn::Min(high, c)), most = hn::Max(high, c);
    // A middle neighbour farther than h does not count; a missing neighbour is treated as one at h.
    const V e1 = hn::Min(hn::Sub(middle, least), h);
    const V e2 = hn::Sub(most, least);
    const V between = hn::Sub(e2, e1);
    // The third takes part where the solution from two exceeds it.
    const M three = hn::Lt(hn::MulAdd(e2, e2, hn::Mul(between, between)), h2);
    const V sum = hn::Add(e1, e2), squares = hn::MulAdd(e1, e1, hn::MulSub(e2, e2, h2));
    const V root2 = hn::NegMulAdd(e1, e1, hn::Add(h2, h2));
    const V root3 = hn::NegMulAdd(hn::Set(d, 3.0f), squares, hn::Mul(sum, sum));
    const V root = hn::Sqrt(hn::Max(hn::IfThenElse(three, root3, root2), hn::Zero(d)));
    const V numerator = hn::Add(hn::IfThenElse(three, sum, e1), root);
    return hn::Mul(numerator, hn::IfThenElse(three, hn::Set(d, 1.0f / 3), hn::Set(d, 0.5f)));
  }

 private:
  float h_;
};

template <>
class Quadratic<false> {
 public:
  explicit Quadratic(const float spacing[3]) {
    for (int a = 0; a < 3; ++a) {
      h_[a] = spacing[a];
      w_[a] = 1 / (spacing[a] * spacing[a]);
    }
  }
  HWY_INLINE V operator()(V a, V b, V c, V least) const {
    const D d;
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    V wa = hn::Set(d, w_[0]), wb = hn::Set(d, w_[1]), wc = hn::Set(d, w_[2]);
    const V h =
        hn::IfThenElse(hn::Eq(a, least), hn::Set(d, h_[0]),
                       hn::IfThenElse(hn::Eq(b, least), hn::Set(d, h_[1]), hn::Set(d, h_[2])));
    Order(a, wa, b, wb);
    Order(b, wb, c, wc);
    Order(a, wa, b, wb);
    const V e1 = hn::Min(hn::Sub(b, least), h), e2 = hn::Sub(c, least);
    const V between = hn::Sub(e2, e1);
    const M three =
        hn::Lt(hn::MulAdd(wa, hn::Mul(e2, e2), hn::Mul(wb, hn::Mul(between, between))), one);
    const V w3 = hn::IfThenElse(three, wc, zero), x3 = hn::IfThenElse(three, e2, zero);
    const V square = hn::Add(hn::Add(wa, wb), w3);
    const V linear = hn::MulAdd(w3, x3, hn::Mul(wb, e1));
    const V constant = hn::MulAdd(w3, hn::Mul(x3, x3), hn::MulSub(wb, hn::Mul(e1, e1), one));
    const V root = hn::Max(hn::MulSub(linear, linear, hn::Mul(square, constant)), zero);
    return hn::Div(hn::Add(linear, hn::Sqrt(root)), square);
  }

 private:
  static HWY_INLINE void Order(V& a, V& wa, V& b, V& wb) {
    const M swap = hn::Gt(a, b);
    const V low = hn::Min(a, b), w = hn::IfThenElse(swap, wb, wa);
    b = hn::Max(a, b);
    wb = hn::IfThenElse(swap, wa, wb);
    a = low;
    wa = w;
  }
  float h_[3], w_[3];
};

}  // namespace HWY_NAMESPACE
}  // namespace obscura
HWY_AFTER_NAMESPACE();

#endif  // include guard
