file(REMOVE_RECURSE
  "CMakeFiles/tact_python.dir/src/arrays.cpp.o"
  "CMakeFiles/tact_python.dir/src/arrays.cpp.o.d"
  "CMakeFiles/tact_python.dir/src/errors.cpp.o"
  "CMakeFiles/tact_python.dir/src/errors.cpp.o.d"
  "CMakeFiles/tact_python.dir/src/module.cpp.o"
  "CMakeFiles/tact_python.dir/src/module.cpp.o.d"
  "CMakeFiles/tact_python.dir/src/report.cpp.o"
  "CMakeFiles/tact_python.dir/src/report.cpp.o.d"
  "CMakeFiles/tact_python.dir/src/types.cpp.o"
  "CMakeFiles/tact_python.dir/src/types.cpp.o.d"
  "CMakeFiles/tact_python.dir/src/world.cpp.o"
  "CMakeFiles/tact_python.dir/src/world.cpp.o.d"
  "tact/_tact.cpython-311-x86_64-linux-gnu.so"
  "tact/_tact.pdb"
)

# Per-language clean rules from dependency scanning.
foreach(lang CXX)
  include(CMakeFiles/tact_python.dir/cmake_clean_${lang}.cmake OPTIONAL)
endforeach()
