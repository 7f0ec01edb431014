# The compile options that every target of tact shares.
#
# -ffp-contract=off: GCC would fuse a*b+c where the machine can, and the bits of an answer would depend on the machine.
# -fno-math-errno, -fno-trapping-math: let loops with sqrt and comparisons use SIMD; they change no result.

# -Wconversion and -Wsign-conversion stay off: meshes count in int, containers in std::size_t, and an index that is known
# not to be negative would need a cast at each of some four hundred accesses, which hides the expression and finds nothing.
# -Wsign-compare, which finds loops that never end, is on with -Wall. A cast is written where a value may change: before a
# product that may leave int, from floating-point numbers, in braces.

# Whether the standard library has the algorithms over ranges; libc++ has them from version 15 on.
include(CheckCXXSourceCompiles)
set(CMAKE_REQUIRED_FLAGS -std=c++20)
check_cxx_source_compiles("#include <algorithm>\nint main() { int a[] = {1, 0}; std::ranges::sort(a); return a[0]; }"
                          TACT_HAS_RANGE_ALGORITHMS)
unset(CMAKE_REQUIRED_FLAGS)

function(tact_options target)
  if(NOT TACT_HAS_RANGE_ALGORITHMS)
    target_compile_options(${target} PRIVATE -include ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/platforms/early_libcxx.h)
  endif()
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES
    CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # false alarms on std::string concatenation in GCC 12 (its bug 105651)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release,RelWithDebInfo>:-Wno-restrict>)
  endif()
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-math-errno -fno-trapping-math -Wall -Wextra -Wpedantic -Wshadow)
  if(TACT_WARNINGS_AS_ERRORS)
    target_compile_options(${target} PRIVATE -Werror)
  endif()
  if(TACT_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${TACT_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # false alarms on std::regex, in instrumented code alone (GCC's bug 105562)
      target_compile_options(${target} PRIVATE -Wno-maybe-uninitialized)
    endif()
    target_link_options(${target} PUBLIC -fsanitize=${TACT_SANITIZE})
  endif()
endfunction()

# Compiles eight sources of a target at a time: reading the headers of CLI11, fmt, GoogleTest or CGAL takes longer than what
# a source does with them. For that, names in unnamed namespaces are unique within a folder.
function(tact_unity_build target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 8)
endfunction()

# The same, but with sources of one folder at a time, up to twelve: a new file does not move the others to other batches.
function(tact_unity_build_by_folder target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # To GCC what a source that includes sources keeps to itself looks as if it stood in a header.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  get_target_property(sources ${target} SOURCES)
  foreach(source ${sources})
    cmake_path(GET source PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    list(APPEND of_${folder} ${source})
    list(LENGTH of_${folder} number)
    math(EXPR batch "(${number} - 1) / 12")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
  endforeach()
endfunction()

# Options of the files that are compiled for AVX2 and AVX-512. GCC does not align the stack of Windows to more than sixteen
# bytes (its bug 54412): there the assembler makes every move of a vector one that needs no alignment.
set(TACT_VECTOR_OPTIONS -O3)
if(MINGW)
  list(APPEND TACT_VECTOR_OPTIONS -Wa,-muse-unaligned-vector-move)
endif()

# A layer of the engine: its objects end in the library tact. Includes are written from the project's root.
function(tact_layer target)
  add_library(${target} OBJECT ${ARGN})
  tact_options(${target})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
  if(TACT_UNITY_BUILD)  # the kernels, which have options of their own, stay alone
    tact_unity_build_by_folder(${target})
  endif()
  if(BUILD_SHARED_LIBS)
    target_compile_definitions(${target} PRIVATE TACT_SHARED TACT_BUILDS_LIBRARY)
  endif()
endfunction()
