# 64-bit Windows by MinGW-w64 with POSIX threads; programs run under Wine. The compiler's own libraries are linked into
# each program, so that it runs where there is no MinGW.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_CROSSCOMPILING_EMULATOR /usr/lib/wine/wine64)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)  # Debian's are for the machine that builds
set(Eigen3_DIR /usr/share/eigen3/cmake CACHE PATH "Headers alone")
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)
# Debian has no Embree for it; a pool of std::thread needs no library of OpenMP beside a DLL.
set(TACT_WITH_EMBREE OFF CACHE BOOL "")
set(TACT_WITH_OPENMP OFF CACHE BOOL "")
