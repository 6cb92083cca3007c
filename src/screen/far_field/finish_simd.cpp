#include "screen/far_field/finish_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/finish_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/cone-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace om = obscura::HWY_NAMESPACE;

void FinishDirections(FinishJob* job) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const V zero = hn::Zero(d), over_pi = hn::Set(d, 0.318309886f), tiny = hn::Set(d, 1e-30f);
  for (int i = 0; i < job->count; i += static_cast<int>(hn::Lanes(d))) {
    V n[3], v[3];
    for (int k = 0; k < 3; ++k) {
      n[k] = hn::LoadU(d, job->normal[k] + i);
      v[k] = hn::NegMulAdd(hn::LoadU(d, job->vector[k] + i), over_pi, n[k]);
      hn::StoreU(v[k], d, job->integral[k] + i);
    }
    const V square = hn::MulAdd(v[0], v[0], hn::MulAdd(v[1], v[1], hn::Mul(v[2], v[2])));
    // Where next to nothing is open its direction is noise.
    const auto known = hn::Gt(square, hn::Set(d, 1e-6f));
    const V scale = om::FastInverseSqrt(d, hn::Max(square, tiny));
    for (int k = 0; k < 3; ++k) {
      hn::StoreU(hn::IfThenElse(known, hn::Mul(v[k], scale), n[k]), d, job->direction[k] + i);
    }
    // N = 2 AO N_ss.
    const V ambient = hn::NegMulAdd(hn::LoadU(d, job->solid + i), hn::Set(d, 0.5f * 0.318309886f),
                                    hn::Set(d, 1.0f));
    const V length = hn::Mul(square, scale);
    const V mean = hn::IfThenElse(
        hn::Gt(ambient, zero),
        hn::Mul(length, om::FastReciprocal(d, hn::Max(hn::Add(ambient, ambient), tiny))),
        hn::Set(d, 0.5f));
    hn::StoreU(hn::IfThenElseZero(known, om::ConeAngle(d, job->paper_cone, mean)), d,
               job->angle + i);
  }
}

void AddRay(const RayJob& job) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const V one = hn::Set(d, 1.0f), b = hn::Set(d, job.b);
  for (int i = 0; i < job.width; i += static_cast<int>(hn::Lanes(d))) {
    const V a = hn::MulAdd(hn::Iota(d, static_cast<float>(i)), hn::Set(d, job.step_a),
                           hn::Set(d, job.first_a));
    const V square = hn::MulAdd(a, a, hn::MulAdd(b, b, one));
    const V along = hn::Mul(hn::LoadU(d, job.ray + i), om::FastInverseSqrt(d, square));
    hn::StoreU(hn::MulAdd(along, a, hn::LoadU(d, job.x + i)), d, job.x + i);
    hn::StoreU(hn::NegMulAdd(along, b, hn::LoadU(d, job.y + i)), d, job.y + i);
    hn::StoreU(hn::Neg(along), d, job.z + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace obscura::far_field
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace obscura::far_field {

HWY_EXPORT(FinishDirections);
HWY_EXPORT(AddRay);

void finish_directions(FinishJob* job) { HWY_DYNAMIC_DISPATCH(FinishDirections)(job); }
void add_ray(const RayJob& job) { HWY_DYNAMIC_DISPATCH(AddRay)(job); }

}  // namespace obscura::far_field
#endif
