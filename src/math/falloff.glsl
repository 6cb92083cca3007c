// rho(d) as math/falloff-inl.h has it. Before this: kFalloff (FalloffKind), view.rho_radius,
// view.inverse_radius, view.entries_per_length and view.last_entry of math::Rho, and
// rho_table(i), its table.
const int kConstantRho = 0;

float rho_between(int i, float t) { return mix(rho_table(i), rho_table(i + 1), t); }

float rho_of(float x) {
  const float t = x * view.inverse_radius;
  if (kFalloff == kConstantRho) return x <= view.rho_radius ? 1.0 : 0.0;
  if (kFalloff == 1) return exp(-t);
  if (kFalloff == 2) return max(1.0 - t, 0.0) * max(1.0 - t, 0.0);
  if (kFalloff == 3) return 1.0 / (t * t + 1.0);
  if (kFalloff == 4) {
    const float at = min(x * view.entries_per_length, float(view.last_entry));
    return x <= view.rho_radius ? rho_between(int(at), at - float(int(at))) : 0.0;
  }
  // A float's upper bits count knots, 64 an octave from 2^-64 to 2^64; the rest is the place between.
  const float first = 1.0 / 18446744073709551616.0;
  if (x < first) return rho_between(0, x / first);
  const int bits = floatBitsToInt(min(x, 18446744073709551616.0));
  return rho_between((bits >> 17) - ((127 - 64) << 6) + 1, float(bits & 0x1ffff) / 131072.0);
}
