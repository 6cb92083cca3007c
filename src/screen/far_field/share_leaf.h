// Leaf functions, C++ and GLSL: see math/leaf-inl.h. Work shared by groups of side x side pixels (2
// or 3), each of which evaluates its share of the directions: which share, and what a neighbour's
// slices count for a pixel.
const float kPlaneGap = 0.5f;    // pixel footprints
const float kLeastAlike = 0.8f;  // cosine between normals
// Tiles where less than this part of the shares reaches a pixel evaluate `side` times as many.
const float kEnough = 0.75f;
const int kKnownUnits = 16;  // of a share; whole numbers, so that devices agree

// Direction k belongs to share k mod side^2. Of 3 x 3 a magic square, so that rows and columns have
// the same mean; of 2 x 2 shares beside each other lie beside each other.
LEAF(int) share_of_cell(int row, int column, int side) {
  return side == 3   ? 3 * (2 * (row + column) % 3) + (1 + row + 2 * column) % 3
         : side == 2 ? 2 * row + (row ^ column)
                     : 0;
}

// Does the pixel evaluate directions of this share?
LEAF(bool) has_share(int own, int share, int side, bool dense) {
  int turn = (share + side * side - own) % (side * side);
  return turn == 0 || (dense && turn % side == 0);
}

// Of tiles of `tile` pixels, row by row in an image `width` wide, the one with a pixel.
LEAF(int) tile_of(int x, int y, int width, int tile) {
  return y / tile * ((width + tile - 1) / tile) + x / tile;
}

// A surface point in eye space, z away from the camera, and its normal, z likewise.
struct SharePoint {
  Real x, y, z;
  Real nx, ny, nz;
};

LEAF(Real) distance_to_plane(SharePoint of, Real dx, Real dy, Real dz) {
  return leaf_abs(leaf_fma(of.nx, dx, leaf_fma(of.ny, dy, of.nz * dz)));
}

// By the place in a window of 3 x 3 pixels: every share has the same where all see one surface.
LEAF(Real) weight_of_place(int dx, int dy, int side) {
  return real(side == 3 ? 1.0f : (dx == 0 ? 1.0f : 0.5f) * (dy == 0 ? 1.0f : 0.5f));
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
  Real over = (cosine - real(kLeastAlike)) * real(1.0f / (1.0f - kLeastAlike));
  return near2 * near2 * leaf_max(over, real(0.0f));
}
