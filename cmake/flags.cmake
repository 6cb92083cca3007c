# Flags shared by every target of this project: link to obscura_flags privately.
add_library(obscura_flags INTERFACE)
target_compile_options(obscura_flags INTERFACE -Wall -Wextra -Wno-psabi
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # GCC 12 warns of std::string itself
  $<$<BOOL:${OBSCURA_WERROR}>:-Werror>)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # The oldest processors served; Highway adds AVX2 and AVX-512 kernels, chosen at run time.
  target_compile_options(obscura_flags INTERFACE -march=x86-64-v2)
  target_compile_definitions(obscura_flags INTERFACE HWY_DISABLE_PCLMUL_AES)
endif()
if(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64|ARM64")
  # NEON is part of every such processor, so that one target is enough. Without the second word
  # Highway (1.0.3) would compile for NEON with cryptography, of which these kernels use nothing and
  # which constructors of plain structs of vectors would have to be told of.
  target_compile_definitions(obscura_flags INTERFACE HWY_COMPILE_ONLY_STATIC TOOLCHAIN_MISS_SYS_AUXV_H)
elseif(OBSCURA_FORCE_SSE4)
  target_compile_definitions(obscura_flags INTERFACE HWY_COMPILE_ONLY_STATIC)
else()
  # It only adds instructions that these kernels do not use.
  target_compile_definitions(obscura_flags INTERFACE HWY_DISABLED_TARGETS=HWY_AVX3_DL)
endif()
# Contraction would make results depend on the compiler; the two others only free the vectoriser.
target_compile_options(obscura_flags INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(OBSCURA_SANITIZE)
  add_compile_options(-fsanitize=${OBSCURA_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${OBSCURA_SANITIZE})
endif()
if(OBSCURA_BUILD_FUZZERS)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
