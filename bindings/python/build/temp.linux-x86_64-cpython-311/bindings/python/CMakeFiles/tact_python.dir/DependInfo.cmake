
# Consider dependencies only in project.
set(CMAKE_DEPENDS_IN_PROJECT_ONLY OFF)

# The set of languages for which implicit dependencies are needed:
set(CMAKE_DEPENDS_LANGUAGES
  )

# The set of dependency files which are needed:
set(CMAKE_DEPENDS_DEPENDENCY_FILES
  "/work/w-python/bindings/python/src/arrays.cpp" "bindings/python/CMakeFiles/tact_python.dir/src/arrays.cpp.o" "gcc" "bindings/python/CMakeFiles/tact_python.dir/src/arrays.cpp.o.d"
  "/work/w-python/bindings/python/src/errors.cpp" "bindings/python/CMakeFiles/tact_python.dir/src/errors.cpp.o" "gcc" "bindings/python/CMakeFiles/tact_python.dir/src/errors.cpp.o.d"
  "/work/w-python/bindings/python/src/module.cpp" "bindings/python/CMakeFiles/tact_python.dir/src/module.cpp.o" "gcc" "bindings/python/CMakeFiles/tact_python.dir/src/module.cpp.o.d"
  "/work/w-python/bindings/python/src/report.cpp" "bindings/python/CMakeFiles/tact_python.dir/src/report.cpp.o" "gcc" "bindings/python/CMakeFiles/tact_python.dir/src/report.cpp.o.d"
  "/work/w-python/bindings/python/src/types.cpp" "bindings/python/CMakeFiles/tact_python.dir/src/types.cpp.o" "gcc" "bindings/python/CMakeFiles/tact_python.dir/src/types.cpp.o.d"
  "/work/w-python/bindings/python/src/world.cpp" "bindings/python/CMakeFiles/tact_python.dir/src/world.cpp.o" "gcc" "bindings/python/CMakeFiles/tact_python.dir/src/world.cpp.o.d"
  )

# Targets to which this target links.
set(CMAKE_TARGET_LINKED_INFO_FILES
  "/work/w-python/bindings/python/build/temp.linux-x86_64-cpython-311/engine/CMakeFiles/tact.dir/DependInfo.cmake"
  )

# Fortran module output directory.
set(CMAKE_Fortran_TARGET_MODULE_DIR "")
