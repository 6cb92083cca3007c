# Packages for Debian 12, one per component, and an archive that can be unpacked anywhere;
# tools/package.sh makes them. CPack asks dpkg-shlibdeps for what a program's libraries are.
set(CPACK_PACKAGE_NAME obscura)
set(CPACK_PACKAGE_CONTACT "The Obscura authors <packages@obscura.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development command doc)
if(OBSCURA_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
# Two builds make the packages: CPACK_INSTALL_CMAKE_PROJECTS names a list for each.
set(CPACK_COMPONENTS_LIBRARY ${CPACK_COMPONENTS_ALL})
list(REMOVE_ITEM CPACK_COMPONENTS_LIBRARY command)
set(CPACK_COMPONENTS_PROGRAM command)
set(CPACK_GENERATOR TZST)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_CURRENT_BINARY_DIR}/src)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ
  GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

# Name, section, text, dependencies and what Debian's policy wants in every package: licence and changes.
function(obscura_package component name section text)
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${what}\n${text}" PARENT_SCOPE)
  list(JOIN ARGN ", " depends)
  set(CPACK_DEBIAN_${upper}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  install(FILES ${papers}/copyright ${papers}/changelog.gz
    DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
endfunction()

set(papers ${CMAKE_CURRENT_BINARY_DIR}/package-papers)
file(READ LICENSE license)
string(REGEX REPLACE "^MIT License\n\n[^\n]*\n\n" "" license "${license}")
string(REGEX REPLACE "\n\n" "\n.\n" license "${license}")
string(REGEX REPLACE "\n([^\n])" "\n \\1" license "${license}")
file(WRITE ${papers}/copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: obscura

Files: *
Copyright: 2026 The Obscura authors
License: Expat
 ${license}")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
file(WRITE ${papers}/changelog "obscura (${PROJECT_VERSION}) unstable; urgency=medium

  * What has changed stands in CHANGELOG.md of obscura-doc.

 -- ${CPACK_PACKAGE_CONTACT}  ${date}
")
execute_process(COMMAND gzip -9nf ${papers}/changelog)

set(version ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(what "Obscura computes how much of the surroundings each point of a picture sees:
from depth images, meshes and volumes, on the CPU and on Vulkan.")
obscura_package(runtime libobscura${version} libs
  "This is the library for programs.")
obscura_package(development libobscura-dev libdevel
  "These are headers, CMake package and pkg-config file."
  "libobscura${version} (= ${PROJECT_VERSION})")
obscura_package(command obscura graphics
  "This is the command obscura with manual pages and completions.")
obscura_package(doc obscura-doc doc
  "These are the pages of methods, settings and files.")
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
if(OBSCURA_BUILD_PYTHON)
  obscura_package(python python3-obscura python
    "This is the Python module obscura."
    "libobscura${version} (= ${PROJECT_VERSION})" "python3 (>= 3.11)" "python3 (<< 3.12)" python3-numpy)
endif()
include(CPack)
