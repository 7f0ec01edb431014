
# Consider dependencies only in project.
set(CMAKE_DEPENDS_IN_PROJECT_ONLY OFF)

# The set of languages for which implicit dependencies are needed:
set(CMAKE_DEPENDS_LANGUAGES
  )

# The set of dependency files which are needed:
set(CMAKE_DEPENDS_DEPENDENCY_FILES
  "/work/w-python/engine/base/error.cpp" "engine/base/CMakeFiles/tact_base.dir/error.cpp.o" "gcc" "engine/base/CMakeFiles/tact_base.dir/error.cpp.o.d"
  "/work/w-python/engine/base/key_sort.cpp" "engine/base/CMakeFiles/tact_base.dir/key_sort.cpp.o" "gcc" "engine/base/CMakeFiles/tact_base.dir/key_sort.cpp.o.d"
  "/work/w-python/engine/base/timer.cpp" "engine/base/CMakeFiles/tact_base.dir/timer.cpp.o" "gcc" "engine/base/CMakeFiles/tact_base.dir/timer.cpp.o.d"
  )

# Targets to which this target links.
set(CMAKE_TARGET_LINKED_INFO_FILES
  )

# Fortran module output directory.
set(CMAKE_Fortran_TARGET_MODULE_DIR "")
