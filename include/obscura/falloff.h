#ifndef OBSCURA_FALLOFF_H_
#define OBSCURA_FALLOFF_H_

#include <functional>
#include <vector>

#include "obscura/export.h"
#include "obscura/settings.h"

namespace obscura {

// rho(d): how much an occluder at distance d counts; R is the radius.
enum class FalloffKind {
  kConstant,       // 1 if d <= R, else 0
  kExponential,    // exp(-d/R)
  kQuadratic,      // max(0, 1 - d/R)^2
  kInverseSquare,  // 1 / (1 + (d/R)^2)
  kTable,          // `table`, linear between its entries, at d = 0 ... R; 0 beyond R
  kFunction,       // `function`(d), any with values in [0, 1]
};
template <>
struct EnumNames<FalloffKind> {
  // What a command line can say; the other two kinds exist in C++ only.
  static constexpr const char* names[] = {"constant", "exponential", "quadratic", "inverse-square"};
};
template <>
inline constexpr int kEnumCount<FalloffKind> = 6;

struct Falloff {
  FalloffKind kind = FalloffKind::kExponential;
  float radius = 1;
  std::vector<float> table{};              // kTable, C++ only: 2 or more values in [0, 1]
  std::function<float(float)> function{};  // kFunction, C++ only: called at set-up only
};
template <FieldsOf<Falloff> Self, class Visitor>
void visit_fields(Self& s, Visitor&& v) {
  v(s.kind, Field{"falloff",
                  "",
                  {},
                  "Weight of an occluder at distance d with radius R: 1 up to R, exp(-d/R), "
                  "(1-d/R)^2 or 1/(1+(d/R)^2)."});
  v(s.radius,
    Field{
        "radius", "world units", positive_or_infinite(),
        "Radius R of the falloff, inf: no falloff; in volumetric obscurance that of the sphere."});
}

OBSCURA_API Status validate(const Falloff& falloff);

}  // namespace obscura

#endif  // OBSCURA_FALLOFF_H_
