#ifndef OBSCURA_SRC_MATH_LEAF_CPP_H_
#define OBSCURA_SRC_MATH_LEAF_CPP_H_

#include "hwy/base.h"

// Words of leaf files that every C++ reading shares.
#define LEAF(type) HWY_INLINE type
#define LEAF_IN(type) const type&
#define LEAF_INOUT(type) type&
#define LEAF_LIST(...) \
  { __VA_ARGS__ }

#endif  // OBSCURA_SRC_MATH_LEAF_CPP_H_
