# Clang with libc++ and without Embree and OpenMP: what Apple's tools have, as far as it is to be had on Linux.
set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_CXX_FLAGS_INIT -stdlib=libc++)
set(TACT_WITH_EMBREE OFF CACHE BOOL "")
set(TACT_WITH_OPENMP OFF CACHE BOOL "")
