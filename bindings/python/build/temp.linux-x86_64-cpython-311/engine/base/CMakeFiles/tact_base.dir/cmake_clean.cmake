file(REMOVE_RECURSE
  "CMakeFiles/tact_base.dir/error.cpp.o"
  "CMakeFiles/tact_base.dir/error.cpp.o.d"
  "CMakeFiles/tact_base.dir/key_sort.cpp.o"
  "CMakeFiles/tact_base.dir/key_sort.cpp.o.d"
  "CMakeFiles/tact_base.dir/timer.cpp.o"
  "CMakeFiles/tact_base.dir/timer.cpp.o.d"
)

# Per-language clean rules from dependency scanning.
foreach(lang CXX)
  include(CMakeFiles/tact_base.dir/cmake_clean_${lang}.cmake OPTIONAL)
endforeach()
