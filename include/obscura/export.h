#ifndef OBSCURA_EXPORT_H_
#define OBSCURA_EXPORT_H_

// Marks what a shared library exports; everything else in it is hidden.
#if defined(__GNUC__)
#define OBSCURA_API __attribute__((visibility("default")))
#else
#define OBSCURA_API
#endif

// Marks what may still change in any version; see docs/compatibility.md.
#define OBSCURA_EXPERIMENTAL

#endif  // OBSCURA_EXPORT_H_
