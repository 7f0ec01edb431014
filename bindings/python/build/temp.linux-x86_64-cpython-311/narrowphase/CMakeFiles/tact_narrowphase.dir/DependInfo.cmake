
# Consider dependencies only in project.
set(CMAKE_DEPENDS_IN_PROJECT_ONLY OFF)

# The set of languages for which implicit dependencies are needed:
set(CMAKE_DEPENDS_LANGUAGES
  )

# The set of dependency files which are needed:
set(CMAKE_DEPENDS_DEPENDENCY_FILES
  "/work/w-python/narrowphase/criteria/criteria.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/criteria/criteria.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/criteria/criteria.cpp.o.d"
  "/work/w-python/narrowphase/criteria/impact_zone.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/criteria/impact_zone.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/criteria/impact_zone.cpp.o.d"
  "/work/w-python/narrowphase/criteria/smallest_enclosing_disk.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/criteria/smallest_enclosing_disk.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/criteria/smallest_enclosing_disk.cpp.o.d"
  "/work/w-python/narrowphase/depth/convex_polytope.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/convex_polytope.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/convex_polytope.cpp.o.d"
  "/work/w-python/narrowphase/depth/expanding_polytope.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/expanding_polytope.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/expanding_polytope.cpp.o.d"
  "/work/w-python/narrowphase/depth/smallest_separation.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/smallest_separation.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/smallest_separation.cpp.o.d"
  "/work/w-python/narrowphase/depth/star_surface.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/star_surface.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/depth/star_surface.cpp.o.d"
  "/work/w-python/narrowphase/direction/adjacent_faces.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/adjacent_faces.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/adjacent_faces.cpp.o.d"
  "/work/w-python/narrowphase/direction/contact_direction.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/contact_direction.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/contact_direction.cpp.o.d"
  "/work/w-python/narrowphase/direction/face_triangle.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/face_triangle.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/face_triangle.cpp.o.d"
  "/work/w-python/narrowphase/direction/minkowski_face.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/minkowski_face.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/direction/minkowski_face.cpp.o.d"
  "/work/w-python/narrowphase/hull/gjk.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/gjk.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/gjk.cpp.o.d"
  "/work/w-python/narrowphase/hull/kdop.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/kdop.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/kdop.cpp.o.d"
  "/work/w-python/narrowphase/hull/minkowski_difference.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/minkowski_difference.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/minkowski_difference.cpp.o.d"
  "/work/w-python/narrowphase/hull/simplex.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/simplex.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/simplex.cpp.o.d"
  "/work/w-python/narrowphase/hull/support.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/support.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/hull/support.cpp.o.d"
  "/work/w-python/narrowphase/kernels/dispatch.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/dispatch.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/dispatch.cpp.o.d"
  "/work/w-python/narrowphase/kernels/kernels_avx2.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/kernels_avx2.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/kernels_avx2.cpp.o.d"
  "/work/w-python/narrowphase/kernels/kernels_avx512.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/kernels_avx512.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/kernels_avx512.cpp.o.d"
  "/work/w-python/narrowphase/kernels/kernels_scalar.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/kernels_scalar.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/kernels/kernels_scalar.cpp.o.d"
  "/work/w-python/narrowphase/mesh/clustered_mesh.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/mesh/clustered_mesh.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/mesh/clustered_mesh.cpp.o.d"
  "/work/w-python/narrowphase/mesh/facet_order.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/mesh/facet_order.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/mesh/facet_order.cpp.o.d"
  "/work/w-python/narrowphase/numeric/double_double.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/numeric/double_double.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/numeric/double_double.cpp.o.d"
  "/work/w-python/narrowphase/numeric/predicates.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/numeric/predicates.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/numeric/predicates.cpp.o.d"
  "/work/w-python/narrowphase/triangles/block_pair.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/block_pair.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/block_pair.cpp.o.d"
  "/work/w-python/narrowphase/triangles/cluster_forest.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/cluster_forest.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/cluster_forest.cpp.o.d"
  "/work/w-python/narrowphase/triangles/confirm.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/confirm.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/confirm.cpp.o.d"
  "/work/w-python/narrowphase/triangles/lattice.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/lattice.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/lattice.cpp.o.d"
  "/work/w-python/narrowphase/triangles/triangle_triangle.cpp" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/triangle_triangle.cpp.o" "gcc" "narrowphase/CMakeFiles/tact_narrowphase.dir/triangles/triangle_triangle.cpp.o.d"
  )

# Targets to which this target links.
set(CMAKE_TARGET_LINKED_INFO_FILES
  )

# Fortran module output directory.
set(CMAKE_Fortran_TARGET_MODULE_DIR "")
