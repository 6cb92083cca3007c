#include "math/falloff.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "core/text.h"

namespace obscura::math {
namespace {

constexpr int kMantissaBits = 23;
constexpr int kFractionBits = kMantissaBits - Rho::kBitsPerOctave;
constexpr std::int32_t kFirstKnot = (Rho::kMinExponent + 127) << Rho::kBitsPerOctave;

float from_table(const Rho& rho, float d) {
  const float t = std::min(d * rho.entries_per_length, static_cast<float>(rho.last_entry));
  const auto i = static_cast<int>(t);
  const float value = rho.table[i] + (t - i) * (rho.table[i + 1] - rho.table[i]);
  return d <= rho.radius ? value : 0.0f;
}

// A float's upper bits count knots, the rest is the place between two of them.
float from_function_table(const Rho& rho, float d) {
  const float first = std::ldexp(1.0f, Rho::kMinExponent);
  const float inside = std::clamp(d, first, std::ldexp(1.0f, Rho::kMaxExponent));
  const auto bits = std::bit_cast<std::int32_t>(inside);
  const std::int32_t i = 1 + (bits >> kFractionBits) - kFirstKnot;
  const float t =
      static_cast<float>(bits & ((1 << kFractionBits) - 1)) * (1.0f / (1 << kFractionBits));
  const float value = rho.table[i] + t * (rho.table[i + 1] - rho.table[i]);
  const float near = rho.table[0] + (d / first) * (rho.table[1] - rho.table[0]);
  return d < first ? near : value;
}

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
    sample(std::bit_cast<float>((kFirstKnot + k) << kFractionBits));
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

float evaluate(const Rho& rho, float d) {
  const float t = d * rho.inverse_radius;
  switch (rho.kind) {
    case FalloffKind::kConstant:
      return d <= rho.radius ? 1.0f : 0.0f;
    case FalloffKind::kExponential:
      return std::exp(-t);
    case FalloffKind::kQuadratic: {
      const float rest = std::max(0.0f, 1 - t);
      return rest * rest;
    }
    case FalloffKind::kInverseSquare:
      return 1 / (1 + t * t);
    case FalloffKind::kTable:
      return from_table(rho, d);
    case FalloffKind::kFunction:
      break;
  }
  return from_function_table(rho, d);
}

}  // namespace obscura::math
