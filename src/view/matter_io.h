#ifndef OBSCURA_SRC_VIEW_MATTER_IO_H_
#define OBSCURA_SRC_VIEW_MATTER_IO_H_

// Numbers of view::Matter, for shaders that read where matter ends.
#define OBSCURA_MATTER_KINDS  \
  IO_NUMBER(kSolid, 0);       \
  IO_NUMBER(kOfThickness, 1); \
  IO_NUMBER(kWithBack, 2)

#endif  // OBSCURA_SRC_VIEW_MATTER_IO_H_
