// Runs the C++ of the pages that needs no device. That of docs/vulkan.md is only compiled.
#include <cstdio>

#include "snippets.h"

int main() {
  const bool readme = run_readme(), sweeping = run_sweeping();
  if (!readme) std::fprintf(stderr, "the C++ of README.md fails\n");
  if (!sweeping) std::fprintf(stderr, "the C++ of docs/methods/occlusion-sweeping.md fails\n");
  return readme && sweeping ? 0 : 1;
}
