
# Consider dependencies only in project.
set(CMAKE_DEPENDS_IN_PROJECT_ONLY OFF)

# The set of languages for which implicit dependencies are needed:
set(CMAKE_DEPENDS_LANGUAGES
  )

# The set of dependency files which are needed:
set(CMAKE_DEPENDS_DEPENDENCY_FILES
  "/work/w-python/broadphase/block_join.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/block_join.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/block_join.cpp.o.d"
  "/work/w-python/broadphase/block_tree.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/block_tree.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/block_tree.cpp.o.d"
  "/work/w-python/broadphase/kernels/dispatch.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/dispatch.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/dispatch.cpp.o.d"
  "/work/w-python/broadphase/kernels/kernels_avx2.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/kernels_avx2.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/kernels_avx2.cpp.o.d"
  "/work/w-python/broadphase/kernels/kernels_avx512.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/kernels_avx512.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/kernels_avx512.cpp.o.d"
  "/work/w-python/broadphase/kernels/kernels_baseline.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/kernels_baseline.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/kernels/kernels_baseline.cpp.o.d"
  "/work/w-python/broadphase/pair_sort.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/pair_sort.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/pair_sort.cpp.o.d"
  "/work/w-python/broadphase/spatial_order.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/spatial_order.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/spatial_order.cpp.o.d"
  "/work/w-python/broadphase/sweep_and_prune.cpp" "broadphase/CMakeFiles/tact_broadphase.dir/sweep_and_prune.cpp.o" "gcc" "broadphase/CMakeFiles/tact_broadphase.dir/sweep_and_prune.cpp.o.d"
  )

# Targets to which this target links.
set(CMAKE_TARGET_LINKED_INFO_FILES
  )

# Fortran module output directory.
set(CMAKE_Fortran_TARGET_MODULE_DIR "")
