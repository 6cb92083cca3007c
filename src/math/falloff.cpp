#include "math/falloff.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/text.h"
#include "math/leaf_scalar.h"

namespace obscura::leaf_scalar {
namespace {

using namespace math;

// What falloff_leaf.h reads of a math::Rho.
struct RhoScalar {
  const Rho& rho;
  const int kFalloff = static_cast<int>(rho.kind);

  LEAF(Real) rho_radius() { return rho.radius; }
  LEAF(Real) rho_inverse_radius() { return rho.inverse_radius; }
  LEAF(Real) rho_entries_per_length() { return rho.entries_per_length; }
  LEAF(Real) rho_last_entry() { return static_cast<float>(rho.last_entry); }
  LEAF(Real) rho_entry(int i) { return rho.table[i]; }
  LEAF(Real) rho_between(Int i, Real t) {
    return leaf_fma(t, rho.table[i + 1] - rho.table[i], rho.table[i]);
  }
  LEAF(Real) rho_exp_negative(Real t) { return std::exp(-t); }
#include "math/falloff_leaf.h"
};

}  // namespace
}  // namespace obscura::leaf_scalar

namespace obscura::math {
namespace {

constexpr std::int32_t kFirstKnotBits = (kFirstOctave + 127) << kKnotBits;
static_assert(kKnotBits + kFractionBits == 23);
static_assert(kConstantRho == int(FalloffKind::kConstant) &&
              kExponentialRho == int(FalloffKind::kExponential) &&
              kQuadraticRho == int(FalloffKind::kQuadratic) &&
              kInverseSquareRho == int(FalloffKind::kInverseSquare) &&
              kTableRho == int(FalloffKind::kTable) && kFunctionRho == int(FalloffKind::kFunction));

Status sample_function(const Falloff& falloff, Rho* rho) {
  rho->table.clear();
  rho->table.reserve(Rho::kFunctionKnots + 2);
  Status status;
  auto sample = [&](float d) {
    const float value = falloff.function(d);
    if (status.ok() && !(value >= 0 && value <= 1)) {
      status = invalid_argument(
          text("falloff.function(", d, ") is ", value, "; its values must be in [0, 1]"));
    }
    rho->table.push_back(value);
  };
  sample(0.0f);
  for (std::int32_t k = 0; k < Rho::kFunctionKnots; ++k) {
    sample(std::bit_cast<float>((kFirstKnotBits + k) << kFractionBits));
  }
  rho->table.push_back(rho->table.back());
  return status;
}

}  // namespace

Status make_rho(const Falloff& falloff, Rho* rho) {
  if (Status s = validate(falloff); !s.ok()) return s;
  Rho result;
  result.kind = falloff.kind;
  // Nearer to 0 its reciprocal would overflow.
  result.radius = std::max(falloff.radius, 1e-37f);
  result.inverse_radius = 1 / result.radius;
  if (falloff.kind == FalloffKind::kTable) {
    result.last_entry = static_cast<int>(falloff.table.size()) - 1;
    result.entries_per_length = static_cast<float>(result.last_entry) / result.radius;
    result.table = falloff.table;
    result.table.push_back(falloff.table.back());
  } else if (falloff.kind == FalloffKind::kFunction) {
    if (Status s = sample_function(falloff, &result); !s.ok()) return s;
  }
  *rho = std::move(result);
  return {};
}

float evaluate(const Rho& rho, float d) { return leaf_scalar::RhoScalar{rho}.rho_of(d); }

}  // namespace obscura::math
