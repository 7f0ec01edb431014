# WebAssembly with registers of sixteen bytes, one thread, by Debian's emscripten; programs run under node.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
# Exceptions are those of WebAssembly: emscripten's older way through JavaScript makes every call in their reach slower.
set(CMAKE_C_FLAGS_INIT -msimd128)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fwasm-exceptions")
# Of node, whose programs end. The package of bindings/js has no JavaScript of emscripten's.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-sALLOW_MEMORY_GROWTH")
# This emscripten would fetch a file as from a server where node has fetch().
set(CMAKE_CROSSCOMPILING_EMULATOR node --no-experimental-fetch)
# Debian's packages of node, which emscripten uses, also for a node that is not Debian's.
set(CMAKE_CXX_LINKER_LAUNCHER env NODE_PATH=/usr/share/nodejs)
# Debian's headers without a library; nothing else of the machine that builds.
set(Eigen3_DIR /usr/share/eigen3/cmake CACHE PATH "")
foreach(package EMBREE OPENMP MPI)
  set(TACT_WITH_${package} OFF CACHE BOOL "")
endforeach()
