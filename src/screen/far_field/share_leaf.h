// Leaf functions, C++ and GLSL: see math/leaf-inl.h. Groups of n x n pixels, each of which has the
// slices of its share of the directions: what a neighbour's slices count for a pixel.
const float kPlaneGap = 0.5f;      // pixel footprints
const float kLeastAlike = 0.8f;    // cosine between normals
const float kOwnWeight = 2.0f;
const float kMeanWeight = 0.3f;    // of the mean over all shares, within one share

// A surface point in eye space, z away from the camera, and its normal, z likewise.
struct SharePoint {
  Real x, y, z;
  Real nx, ny, nz;
};

LEAF(Real) distance_to_plane(SharePoint of, Real dx, Real dy, Real dz) {
  return leaf_abs(leaf_fma(of.nx, dx, leaf_fma(of.ny, dy, of.nz * dz)));
}

// By the squared distance in the image: exp(-square / 2), and the pixel's own.
LEAF(Real) weight_apart(int square) {
  return real(square == 0 ? kOwnWeight : square == 1 ? 0.60653066f : 0.36787944f);
}

// By the larger of the distances from each to the other's plane, in kPlaneGap footprints: about
// exp(-e^2), with an end; and by how alike the normals are.
LEAF(Real) weight_of_surface(SharePoint own, SharePoint other, Real inverse_footprint) {
  Real dx = other.x - own.x;
  Real dy = other.y - own.y;
  Real dz = other.z - own.z;
  Real gap = leaf_max(distance_to_plane(own, dx, dy, dz), distance_to_plane(other, dx, dy, dz));
  Real e = gap * inverse_footprint * real(0.5f / kPlaneGap);
  Real near = leaf_max(leaf_nfma(e, e, real(1.0f)), real(0.0f));
  Real near2 = near * near;
  Real cosine = leaf_fma(own.nx, other.nx, leaf_fma(own.ny, other.ny, own.nz * other.nz));
  Real alike = leaf_max((cosine - real(kLeastAlike)) * real(1.0f / (1.0f - kLeastAlike)), real(0.0f));
  return near2 * near2 * alike;
}

// Of a share with this sum of weights, beside the mean of all shares.
LEAF(Real) share_certainty(Real weights) { return leaf_reciprocal(weights + real(kMeanWeight)); }
