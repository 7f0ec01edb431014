
# Consider dependencies only in project.
set(CMAKE_DEPENDS_IN_PROJECT_ONLY OFF)

# The set of languages for which implicit dependencies are needed:
set(CMAKE_DEPENDS_LANGUAGES
  )

# The set of dependency files which are needed:
set(CMAKE_DEPENDS_DEPENDENCY_FILES
  "/work/w-python/engine/bodies.cpp" "engine/CMakeFiles/tact.dir/bodies.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/bodies.cpp.o.d"
  "/work/w-python/engine/packed_meshes.cpp" "engine/CMakeFiles/tact.dir/packed_meshes.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/packed_meshes.cpp.o.d"
  "/work/w-python/engine/pair/pair_table.cpp" "engine/CMakeFiles/tact.dir/pair/pair_table.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/pair/pair_table.cpp.o.d"
  "/work/w-python/engine/pair/pair_work.cpp" "engine/CMakeFiles/tact.dir/pair/pair_work.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/pair/pair_work.cpp.o.d"
  "/work/w-python/engine/patches.cpp" "engine/CMakeFiles/tact.dir/patches.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/patches.cpp.o.d"
  "/work/w-python/engine/report.cpp" "engine/CMakeFiles/tact.dir/report.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/report.cpp.o.d"
  "/work/w-python/engine/step.cpp" "engine/CMakeFiles/tact.dir/step.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/step.cpp.o.d"
  "/work/w-python/engine/step_statistics.cpp" "engine/CMakeFiles/tact.dir/step_statistics.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/step_statistics.cpp.o.d"
  "/work/w-python/engine/step_trace.cpp" "engine/CMakeFiles/tact.dir/step_trace.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/step_trace.cpp.o.d"
  "/work/w-python/engine/world.cpp" "engine/CMakeFiles/tact.dir/world.cpp.o" "gcc" "engine/CMakeFiles/tact.dir/world.cpp.o.d"
  )

# Targets to which this target links.
set(CMAKE_TARGET_LINKED_INFO_FILES
  )

# Fortran module output directory.
set(CMAKE_Fortran_TARGET_MODULE_DIR "")
