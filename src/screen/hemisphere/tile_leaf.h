// Leaf constants, C++ and GLSL: see math/leaf-inl.h. What differs from pixel to pixel of the
// pattern's tile.
const int kTileCos = 0, kTileSin = 1;            // rotation of the pattern
const int kTileShift = 2;                        // share of a stratum to go down
const int kTileOffset = 3;                       // share of a step to go on
const int kTileMean = 4;                         // 3: mean w in the receiver's frame
const int kTileCosineMean = kTileMean + 3;       // 3: mean w, weights n.w
const int kTileCosineSum = kTileCosineMean + 3;  // sum of n.w
const int kTileValues = kTileCosineSum + 1;
