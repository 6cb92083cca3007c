# Precompiled headers: the standard library (and what else is given) parsed once per target instead
# of once per file. A file still includes all that it uses: the preset `clang` builds without them.
set(OBSCURA_STANDARD_HEADERS <algorithm> <array> <bit> <cmath> <cstddef> <cstdint> <functional>
  <limits> <memory> <numbers> <optional> <span> <string> <string_view> <utility> <vector>)

function(obscura_precompile target)
  target_precompile_headers(${target} PRIVATE ${OBSCURA_STANDARD_HEADERS} ${ARGN})
  obscura_may_cache(${target})
endfunction()

# Takes the headers of another target, which has the same options.
function(obscura_precompiled_as target other)
  target_precompile_headers(${target} REUSE_FROM ${other})
  obscura_may_cache(${target})
endfunction()

function(obscura_may_cache target)
  # ccache needs to see which precompiled header a file takes.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()
