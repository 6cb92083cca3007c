include(CMakePackageConfigHelpers)
# Components are the packages of cmake/package.cmake: runtime, development, command, doc.
install(TARGETS obscura EXPORT obscuraTargets
  LIBRARY COMPONENT runtime NAMELINK_COMPONENT development
  ARCHIVE COMPONENT development)
install(DIRECTORY include/obscura DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
  FILES_MATCHING PATTERN "*.h" PATTERN "*.glsl")
install(EXPORT obscuraTargets NAMESPACE obscura:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/obscura
  COMPONENT development)
configure_package_config_file(cmake/obscuraConfig.cmake.in obscuraConfig.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/obscura)
write_basic_package_version_file(obscuraConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/obscuraConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/obscuraConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/obscura COMPONENT development)
# What a static library needs; a shared one says it itself.
if(BUILD_SHARED_LIBS)
  set(OBSCURA_PC_REQUIRES "")
elseif(OBSCURA_THREADS STREQUAL tbb)
  set(OBSCURA_PC_REQUIRES "libhwy tbb")
else()
  set(OBSCURA_PC_REQUIRES "libhwy")
endif()
# From the folder of the .pc file to the prefix, so that an installed tree can be moved.
file(RELATIVE_PATH OBSCURA_PC_UP "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
configure_file(cmake/obscura.pc.in obscura.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/obscura.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
  COMPONENT development)
if(TARGET obscura_command)
  install(TARGETS obscura_command COMPONENT command)
  if(TARGET obscura_vdb_reader)
    install(TARGETS obscura_vdb_reader COMPONENT command
      DESTINATION ${CMAKE_INSTALL_LIBEXECDIR}/obscura)
  endif()
  # Made on request, as the command must run for it: cmake --build FOLDER --target obscura_manual
  set(manual ${CMAKE_CURRENT_BINARY_DIR}/manual)
  add_custom_target(obscura_manual
    COMMAND ${PROJECT_SOURCE_DIR}/tools/manual.sh $<TARGET_FILE:obscura_command> ${manual} VERBATIM)
  add_dependencies(obscura_manual obscura_command)
  install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_DATADIR} COMPONENT command OPTIONAL)
endif()
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/obscura/docs COMPONENT doc)
install(FILES README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/obscura COMPONENT doc)
# On request: cmake --install FOLDER --component measure
foreach(program obscura-reproduce obscura-bench)
  if(TARGET ${program})
    install(TARGETS ${program} COMPONENT measure EXCLUDE_FROM_ALL)
  endif()
endforeach()
if(TARGET obscura_mpi)
  install(TARGETS obscura_mpi COMPONENT mpi EXCLUDE_FROM_ALL)
endif()
include(cmake/package.cmake)
