file(REMOVE_RECURSE
  "CMakeFiles/tact.dir/bodies.cpp.o"
  "CMakeFiles/tact.dir/bodies.cpp.o.d"
  "CMakeFiles/tact.dir/packed_meshes.cpp.o"
  "CMakeFiles/tact.dir/packed_meshes.cpp.o.d"
  "CMakeFiles/tact.dir/pair/pair_table.cpp.o"
  "CMakeFiles/tact.dir/pair/pair_table.cpp.o.d"
  "CMakeFiles/tact.dir/pair/pair_work.cpp.o"
  "CMakeFiles/tact.dir/pair/pair_work.cpp.o.d"
  "CMakeFiles/tact.dir/patches.cpp.o"
  "CMakeFiles/tact.dir/patches.cpp.o.d"
  "CMakeFiles/tact.dir/report.cpp.o"
  "CMakeFiles/tact.dir/report.cpp.o.d"
  "CMakeFiles/tact.dir/step.cpp.o"
  "CMakeFiles/tact.dir/step.cpp.o.d"
  "CMakeFiles/tact.dir/step_statistics.cpp.o"
  "CMakeFiles/tact.dir/step_statistics.cpp.o.d"
  "CMakeFiles/tact.dir/step_trace.cpp.o"
  "CMakeFiles/tact.dir/step_trace.cpp.o.d"
  "CMakeFiles/tact.dir/world.cpp.o"
  "CMakeFiles/tact.dir/world.cpp.o.d"
  "libtact.a"
  "libtact.pdb"
)

# Per-language clean rules from dependency scanning.
foreach(lang CXX)
  include(CMakeFiles/tact.dir/cmake_clean_${lang}.cmake OPTIONAL)
endforeach()
