// A texel of the pyramid of moments: the mean's bits, then the deviation's, their lowest 12 replaced
// by the share of surface. Levels are made from the texels of levels, so there are more bits of share
// than the CPU's, whose levels are made from floats.
const uint kShareBits = 12u;
const uint kFullShare = (1u << kShareBits) - 1u;

uvec2 pack_moments(float share, float mean, float deviation) {
  // Rounded; deviations are finite.
  const uint bits = floatBitsToUint(deviation) + (1u << (kShareBits - 1u));
  return uvec2(floatBitsToUint(mean), (bits & ~kFullShare) | uint(round(share * float(kFullShare))));
}

// Share, mean, deviation. The mean is 0 where the share is none at all, before it was rounded.
vec3 unpack_moments(uvec2 texel) {
  return vec3(float(texel.y & kFullShare) * (1.0 / float(kFullShare)), uintBitsToFloat(texel.x),
              uintBitsToFloat(texel.y & ~kFullShare));
}
