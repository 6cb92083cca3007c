// Leaf constants, C++ and GLSL: see math/leaf-inl.h. FalloffKind, and the table of a function,
// whose knots are a float's upper bits (math::Rho).
const int kConstantRho = 0, kExponentialRho = 1, kQuadraticRho = 2, kInverseSquareRho = 3;
const int kTableRho = 4, kFunctionRho = 5;

const int kKnotBits = 6;       // 2^6 knots an octave
const int kFractionBits = 17;  // of a float's 23
const int kFirstOctave = -64, kLastOctave = 64;
const float kFirstKnot = 5.421010862427522e-20f, kLastKnot = 18446744073709551616.0f;
const float kPerFirstKnot = 18446744073709551616.0f;
