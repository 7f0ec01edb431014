file(REMOVE_RECURSE
  "CMakeFiles/tact_broadphase.dir/block_join.cpp.o"
  "CMakeFiles/tact_broadphase.dir/block_join.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/block_tree.cpp.o"
  "CMakeFiles/tact_broadphase.dir/block_tree.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/kernels/dispatch.cpp.o"
  "CMakeFiles/tact_broadphase.dir/kernels/dispatch.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/kernels/kernels_avx2.cpp.o"
  "CMakeFiles/tact_broadphase.dir/kernels/kernels_avx2.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/kernels/kernels_avx512.cpp.o"
  "CMakeFiles/tact_broadphase.dir/kernels/kernels_avx512.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/kernels/kernels_baseline.cpp.o"
  "CMakeFiles/tact_broadphase.dir/kernels/kernels_baseline.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/pair_sort.cpp.o"
  "CMakeFiles/tact_broadphase.dir/pair_sort.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/spatial_order.cpp.o"
  "CMakeFiles/tact_broadphase.dir/spatial_order.cpp.o.d"
  "CMakeFiles/tact_broadphase.dir/sweep_and_prune.cpp.o"
  "CMakeFiles/tact_broadphase.dir/sweep_and_prune.cpp.o.d"
)

# Per-language clean rules from dependency scanning.
foreach(lang CXX)
  include(CMakeFiles/tact_broadphase.dir/cmake_clean_${lang}.cmake OPTIONAL)
endforeach()
