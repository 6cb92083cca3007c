#include "screen/far_field/finish_kernel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "screen/far_field/finish_simd.cpp"
#include "hwy/foreach_target.h"
// After foreach_target.
#include "hwy/highway.h"
#include "math/leaf-inl.h"

HWY_BEFORE_NAMESPACE();
namespace obscura::far_field {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
namespace leaf = obscura::HWY_NAMESPACE::leaf;

void FinishDirections(FinishJob* job) {
  const hn::ScalableTag<float> d;
  using V = hn::Vec<decltype(d)>;
  const V over_pi = hn::Set(d, 0.318309886f);
  for (int i = 0; i < job->count; i += static_cast<int>(hn::Lanes(d))) {
    V n[3], v[3];
    for (int k = 0; k < 3; ++k) {
      n[k] = hn::LoadU(d, job->normal[k] + i);
      v[k] = hn::NegMulAdd(hn::LoadU(d, job->vector[k] + i), over_pi, n[k]);
      hn::StoreU(v[k], d, job->integral[k] + i);
    }
    // N = 2 AO N_ss.
    const V ambient = hn::NegMulAdd(hn::LoadU(d, job->solid + i), hn::Set(d, 0.5f * 0.318309886f),
                                    hn::Set(d, 1.0f));
    const leaf::BentCone cone = leaf::bent_cone(job->paper_cone, v[0], v[1], v[2],
                                                hn::Add(ambient, ambient), n[0], n[1], n[2]);
    hn::StoreU(cone.x, d, job->direction[0] + i);
    hn::StoreU(cone.y, d, job->direction[1] + i);
    hn::StoreU(cone.z, d, job->direction[2] + i);
    hn::StoreU(cone.angle, d, job->angle + i);
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
    const V along = hn::Mul(hn::LoadU(d, job.ray + i), leaf::leaf_inverse_sqrt(square));
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
