// docs/compatibility.md, compiled only.
#include "version_includes.inc"
// After the header that defines the macros.
#include "version.inc"
