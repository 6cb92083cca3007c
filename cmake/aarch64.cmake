# Cross-compiles the library and its unit tests for 64-bit ARM; see tools/aarch64.sh, which fetches
# what stands in the sysroot.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(sysroot ${CMAKE_CURRENT_LIST_DIR}/../build/aarch64-root/usr)
list(APPEND CMAKE_PREFIX_PATH ${sysroot} ${sysroot}/lib/aarch64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(CMAKE_CROSSCOMPILING_EMULATOR
  qemu-aarch64;-L;/usr/aarch64-linux-gnu;-E;LD_LIBRARY_PATH=${sysroot}/lib/aarch64-linux-gnu)
