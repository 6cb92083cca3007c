# Compiles SHADER to SPIR-V and writes it to HEADER as obscura::vulkan::shaders::NAME.
get_filename_component(folder ${HEADER} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(
  COMMAND ${GLSLANG_VALIDATOR} -V --target-env vulkan1.1 -I${INCLUDE} --depfile ${HEADER}.d
    -o ${HEADER}.spv ${SHADER}
  OUTPUT_VARIABLE output RESULT_VARIABLE result)
if(result)
  message(FATAL_ERROR "${output}")
endif()
# The header, not the binary, is what the dependencies belong to.
file(READ ${HEADER}.d dependencies)
string(REPLACE "${HEADER}.spv:" "${HEADER}:" dependencies "${dependencies}")
file(WRITE ${HEADER}.d "${dependencies}")
file(READ ${HEADER}.spv bytes HEX)
string(REGEX REPLACE "(..)(..)(..)(..)" "0x\\4\\3\\2\\1,\n" words "${bytes}")
file(WRITE ${HEADER} "#include <cstdint>
namespace obscura::vulkan::shaders {
inline constexpr std::uint32_t ${NAME}[] = {
${words}};
}
")
