// rho(d) of the pass's falloff. Before this: kFalloff (FalloffKind), view.rho_radius,
// view.inverse_radius, view.entries_per_length and view.last_entry of math::Rho, and rho_table(i),
// its table.
#include "math/falloff_kinds_leaf.h"

float rho_radius() { return view.rho_radius; }
float rho_inverse_radius() { return view.inverse_radius; }
float rho_entries_per_length() { return view.entries_per_length; }
float rho_last_entry() { return float(view.last_entry); }
float rho_entry(int i) { return rho_table(i); }
float rho_between(int i, float t) { return mix(rho_table(i), rho_table(i + 1), t); }
float rho_exp_negative(float t) { return exp(-t); }

#include "math/falloff_leaf.h"
