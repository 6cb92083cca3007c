// Leaf functions, C++ and GLSL: see math/leaf-inl.h; after math/slice_leaf.h. No include guard, for
// it is included once per SIMD target. Directions around a receiver's zenith and their lines in the
// image, in the coordinates of math/azimuth_leaf.h (u right, v down, w along the view).

// The least n.zenith: a visible surface does not turn farther away from the camera.
const float kEdgeOnNormal = 1e-3f;

// A receiver and two tangents at right angles to its zenith. Directions are spread evenly around
// the zenith, so that each stands for the same azimuth w_k = 2 pi / K of equation 2.
struct LineReceiver {
  Real z, distance;              // depth; depth, or 1 where rays are parallel
  Real a, b, ray_length;         // the ray (a, b, 1) or (0, 0, 1)
  Real t1u, t1w, t2u, t2v, t2w;  // the tangents; t1v = 0
  Real nu, nv, nw;               // the normal
  Real nz, inverse_nz, nr;       // along the zenith; n.ray
  Real u, v;                     // pixel of the whole image
  Real limit;                    // what is as deep as that counts as background
};
// (nx, ny, nz) is the normal in eye space.
LEAF(LineReceiver)
make_line_receiver(Real u, Real v, Real z, Real nx, Real ny, Real nz, Real a, Real b,
                   bool parallel) {
  Real one = real(1.0f);
  LineReceiver r;
  r.z = z;
  r.distance = parallel ? one : z;
  r.u = u;
  r.v = v;
  r.a = a;
  r.b = b;
  Real across = leaf_sqrt(leaf_fma(a, a, one));
  r.ray_length = length_of_ray(a, b);
  r.t1u = one / across;
  r.t1w = leaf_neg(a * r.t1u);
  Real scale = r.t1u / r.ray_length;
  r.t2u = leaf_neg((a * b) * scale);
  r.t2v = across / r.ray_length;
  r.t2w = leaf_neg(b * scale);

  r.nu = nx;
  r.nv = leaf_neg(ny);
  r.nw = leaf_neg(nz);
  Real inverse = one / r.ray_length;
  r.nr = leaf_fma(r.nu, a, leaf_fma(r.nv, b, r.nw));
  r.nz = leaf_neg(r.nr * inverse);
  Real bend = leaf_max(real(kEdgeOnNormal) - r.nz, real(0.0f)) * inverse;
  r.nu = leaf_nfma(bend, a, r.nu);
  r.nv = leaf_nfma(bend, b, r.nv);
  r.nw = r.nw - bend;
  r.nz = leaf_max(r.nz, real(kEdgeOnNormal));
  r.nr = leaf_neg(r.nz * r.ray_length);
  r.inverse_nz = one / r.nz;
  r.limit = leaf_inf();
  return r;
}

// One direction around the zenith and its line in the image.
struct ImageLine {
  Real tu, tv, tw;    // the tangent
  Real nt;            // the normal along it
  Real du, dv, last;  // pixels: unit step, and how far the samples go
  Real per_pixel;     // how far a pixel goes along the tangent, at distance 1
};
// Pixels from `at` to the last texel along a step.
LEAF(Real) room_to_border(Real at, Real step, Real last) {
  Real room = leaf_select(leaf_less(real(0.0f), step), last - at, at);
  return room / leaf_max(leaf_abs(step), real(1e-6f));
}
// `reach` is in world units, the image's last texel is (last_u, last_v).
LEAF(ImageLine)
make_image_line(LEAF_IN(LineReceiver) r, Real cosine, Real sine, Real per_scale_u, Real per_scale_v,
                Real reach, Real last_u, Real last_v) {
  ImageLine line;
  line.tu = leaf_fma(cosine, r.t1u, sine * r.t2u);
  line.tv = sine * r.t2v;
  line.tw = leaf_fma(cosine, r.t1w, sine * r.t2w);
  line.nt = leaf_fma(r.nu, line.tu, leaf_fma(r.nv, line.tv, r.nw * line.tw));
  // The half-plane of zenith and tangent holds the camera: the image of all of it is a line.
  Real gu = leaf_nfma(r.a, line.tw, line.tu) * per_scale_u;
  Real gv = leaf_nfma(r.b, line.tw, line.tv) * per_scale_v;
  Real square = leaf_fma(gu, gu, gv * gv);
  Real inverse = real(1.0f) / leaf_sqrt(square);
  line.per_pixel = inverse;
  line.du = gu * inverse;
  line.dv = gv * inverse;
  // No farther than the last texels of the image.
  Real pixels = reach * (square * inverse) / r.distance;
  line.last = leaf_min(leaf_min(pixels, room_to_border(r.u, line.du, last_u)),
                       room_to_border(r.v, line.dv, last_v));
  return line;
}

// Distance of sample j in pixels: at least one more than the one before, as far as there are any.
LEAF(Real)
sample_at(LEAF_IN(ImageLine) line, Real shift, Real j, Real per_step, bool squared) {
  Real share = (shift + j) * per_step;
  if (squared) share = share * share;
  return leaf_min(leaf_max(share * line.last, j + real(1.0f)), line.last);
}

// A surface point in the half-plane of zenith and tangent: x along the tangent, y along the zenith.
struct LinePoint {
  Real x, y;
  Truth valid;
};
// Of the texel (ku, kv) away, in pixels times the size of a pixel, at `depth`. It is moved parallel
// to the tangent plane from where its centre lies into the half-plane, so that planes of any tilt
// stay planes. With k = (ku, kv, 0) the point is at depth (r + k) - z r from the receiver; r.t = 0.
LEAF(LinePoint)
line_point(LEAF_IN(LineReceiver) r, LEAF_IN(ImageLine) line, Real ku, Real kv, Real depth,
           bool parallel) {
  LinePoint p;
  p.valid = leaf_less(depth, r.limit);
  Real q = leaf_select(p.valid, depth, r.z);
  Real away = parallel ? r.distance : q;
  p.x = away * leaf_fma(ku, line.tu, kv * line.tv);
  Real nk = leaf_fma(ku, r.nu, kv * r.nv);
  Real height = leaf_fma(away, nk, (q - r.z) * r.nr);
  p.y = leaf_nfma(line.nt, p.x, height) * r.inverse_nz;
  p.valid = leaf_both(p.valid, leaf_less(real(0.0f), p.x));
  return p;
}

// rho = 1 up to R: cos of the zenith angle down to which the matter below a sample, which hangs
// along the sample's view ray, reaches within the sphere of radius R; -2 where it does not. With
// gamma the angle at the camera, C its distance and D = C sin gamma the distance of the ray, the
// ray enters the sphere at the zenith angle asin(D / R) - gamma.
LEAF(Real) cut_cosine(LEAF_IN(Slice) s, Real x, Real y, Real radius, Real inverse_radius) {
  Real zero = real(0.0f);
  Real square = leaf_fma(x, x, y * y);
  Real cosine = y * leaf_inverse_sqrt(leaf_max(square, real(1e-37f)));
  Truth outside = leaf_not(leaf_less_equal(square, radius * radius));
  if (leaf_any(outside)) {
    MatterLine line = view_line(s, x, y);
    Real e2 = leaf_fma(line.ex, line.ex, line.ey * line.ey);
    Real e = leaf_inverse_sqrt(leaf_max(e2, real(1e-37f)));
    Real distance = line.numerator * (e * inverse_radius);
    Real rest = leaf_nfma(distance, distance, real(1.0f));
    Real up = leaf_sqrt(leaf_max(rest, zero)) * (line.ey * e);
    Real entry = leaf_fma(distance, line.ex * e, leaf_neg(up));
    // Only a sample between camera and sphere hangs its matter through it.
    Truth in_front = leaf_less(leaf_fma(x, line.ex, y * line.ey), zero);
    Truth cut = leaf_both(in_front, leaf_less(zero, rest));
    cosine = leaf_select(outside, leaf_select(cut, entry, real(-2.0f)), cosine);
  }
  return cosine;
}

// What a direction has obscured: of the visibility and the solid angle, and of directions along the
// tangent and the zenith.
struct Obscured {
  Real visibility, solid, along, zenith;
};

// Bavoil et al.: elevations h over the plane at right angles to the zenith, from the tangent
// plane's t on; AO = 1/(2 pi) integral of the sum of W(r_i) (sin h_i - sin h_(i-1)). Sines of h,
// and the sum.
struct ClassicHorizon {
  Real start, sine, obscured;
};
LEAF(ClassicHorizon)
start_classic(LEAF_IN(LineReceiver) r, LEAF_IN(ImageLine) line, Real bias_sine, Real bias_cosine) {
  Real scale = leaf_inverse_sqrt(leaf_fma(r.nz, r.nz, line.nt * line.nt));
  Real tangent_sine = leaf_neg(line.nt * scale);
  ClassicHorizon h;
  h.start = leaf_fma(tangent_sine, bias_cosine, (r.nz * scale) * bias_sine);
  h.sine = h.start;
  h.obscured = real(0.0f);
  return h;
}
// `inverse_square` is 1/R^2, of W = 1 - r^2/R^2.
LEAF(void)
add_classic(LEAF_IN(LinePoint) p, Real inverse_square, LEAF_INOUT(ClassicHorizon) h) {
  Real square = leaf_max(leaf_fma(p.x, p.x, p.y * p.y), real(1e-37f));
  Real sine = p.y * leaf_inverse_sqrt(square);
  Real weight = leaf_nfma(square, inverse_square, real(1.0f));
  Truth counts =
      leaf_both(leaf_both(p.valid, leaf_less(real(0.0f), weight)), leaf_less(h.sine, sine));
  h.obscured = h.obscured + leaf_where(counts, weight * (sine - h.sine));
  h.sine = leaf_select(counts, sine, h.sine);
}
// Directions: what a slice has lost is taken to lie evenly over s = sin h from the tangent plane to
// the horizon, with mean s and mean square of cos h = 1 - (mean s)^2 - extent^2/12.
LEAF(Obscured) finish_classic(LEAF_IN(ClassicHorizon) h) {
  Real one = real(1.0f);
  Real mean = real(0.5f) * (h.start + h.sine), extent = h.sine - h.start;
  Real spread = (extent * extent) * real(1.0f / 12.0f);
  Real rest = leaf_max(leaf_nfma(mean, mean, one - spread), real(0.0f));
  Obscured o;
  o.visibility = h.obscured;
  o.solid = h.obscured;
  o.along = h.obscured * leaf_sqrt(rest);
  o.zenith = h.obscured * mean;
  return o;
}

// Sums over the directions, along the two tangents and the zenith.
struct ObscuredSums {
  Real visibility, solid, t1, t2, zenith;
};
LEAF(ObscuredSums) nothing_obscured() {
  ObscuredSums s;
  s.visibility = real(0.0f);
  s.solid = real(0.0f);
  s.t1 = real(0.0f);
  s.t2 = real(0.0f);
  s.zenith = real(0.0f);
  return s;
}
LEAF(void)
add_obscured(LEAF_IN(Obscured) o, Real cosine, Real sine, bool directions,
             LEAF_INOUT(ObscuredSums) s) {
  s.visibility = s.visibility + o.visibility;
  s.solid = s.solid + o.solid;
  if (directions) {
    s.t1 = leaf_fma(o.along, cosine, s.t1);
    s.t2 = leaf_fma(o.along, sine, s.t2);
    s.zenith = o.zenith + s.zenith;
  }
}

// The channels of directions: `whole` n - each * sum, in eye space (x right, y up, z to the
// camera).
struct EyeVector {
  Real x, y, z;
};
LEAF(EyeVector)
obscured_in_eye_space(LEAF_IN(LineReceiver) r, Real nx, Real ny, Real nz, LEAF_IN(ObscuredSums) s,
                      Real whole, Real each) {
  Real zenith = s.zenith / r.ray_length;
  Real u = leaf_fma(s.t1, r.t1u, leaf_nfma(zenith, r.a, s.t2 * r.t2u));
  Real v = leaf_nfma(zenith, r.b, s.t2 * r.t2v);
  Real w = leaf_fma(s.t1, r.t1w, leaf_fms(s.t2, r.t2w, zenith));
  EyeVector e;
  e.x = leaf_nfma(each, u, whole * nx);
  e.y = leaf_fma(each, v, whole * ny);
  e.z = leaf_fma(each, w, whole * nz);
  return e;
}
