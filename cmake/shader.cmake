# Compiles SHADER to SPIR-V and writes it to HEADER as obscura::gpu::shaders::NAME, together with its
# interface, whose header IO lies beside the shader.
get_filename_component(folder ${HEADER} DIRECTORY)
file(MAKE_DIRECTORY ${folder})

# The words of SHADER, compiled with the rest of the arguments; the header depends on what it reads.
function(compile words)
  execute_process(
    COMMAND ${GLSLANG_VALIDATOR} -V --target-env vulkan1.1 -I${INCLUDE} -I${INCLUDE}/../include --depfile ${HEADER}.d
      ${ARGN} -o ${HEADER}.spv ${SHADER}
    OUTPUT_VARIABLE output RESULT_VARIABLE result)
  if(result)
    message(FATAL_ERROR "${output}")
  endif()
  file(READ ${HEADER}.spv bytes HEX)
  string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" bytes "${bytes}")
  set(${words} "${bytes}" PARENT_SCOPE)
endfunction()

compile(words)
# The header, not the binary, is what the dependencies belong to.
file(READ ${HEADER}.d dependencies)
string(REPLACE "${HEADER}.spv:" "${HEADER}:" dependencies "${dependencies}")
set(second "{}")
if(dependencies MATCHES "gpu/results.glsl")
  compile(scratch_words -DTO_SCRATCH)
  set(second "${NAME}_to_scratch")
  set(scratch_array "inline constexpr std::uint32_t ${NAME}_to_scratch[] = {
${scratch_words}};
")
endif()
file(WRITE ${HEADER}.d "${dependencies}")
file(WRITE ${HEADER} "#pragma once
#include \"gpu/shader.h\"
#include \"${IO}\"
namespace obscura::gpu::shaders {
inline constexpr std::uint32_t ${NAME}_words[] = {
${words}};
${scratch_array}inline constexpr Shader ${NAME}{${NAME}_words, ${second}, &${NAME}_io::kInterface};
}
")
