# CGAL::CGAL for another platform, where find_package() does not find it: Debian's package is of the machine that builds.
# Its headers and those of Boost are of no platform. Without GMP for the platform CGAL computes with its own MP_Float, and
# the oracles with the integers of Boost (tests/support/oracles/exact_numbers.h).
if(TARGET CGAL::CGAL OR NOT CMAKE_CROSSCOMPILING)
  return()
endif()
find_path(TACT_CGAL_HEADERS CGAL/version.h PATHS /usr/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
find_path(TACT_BOOST_HEADERS boost/multiprecision/cpp_int.hpp PATHS /usr/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
if(NOT TACT_CGAL_HEADERS OR NOT TACT_BOOST_HEADERS)
  return()
endif()
# These folders alone: beside them stand the headers of this machine's C library.
set(headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers})
file(CREATE_LINK ${TACT_CGAL_HEADERS}/CGAL ${headers}/CGAL SYMBOLIC)
file(CREATE_LINK ${TACT_BOOST_HEADERS}/boost ${headers}/boost SYMBOLIC)
add_library(CGAL::CGAL INTERFACE IMPORTED GLOBAL)
target_include_directories(CGAL::CGAL INTERFACE ${headers})
# GCC for ARM notes calls whose convention changed in its version 10.
target_compile_options(CGAL::CGAL INTERFACE "$<$<CXX_COMPILER_ID:GNU>:-frounding-math;-Wno-psabi>")
find_library(TACT_GMP gmp)
find_library(TACT_GMPXX gmpxx)
find_library(TACT_MPFR mpfr)
if(TACT_GMP AND TACT_GMPXX AND TACT_MPFR)
  target_compile_definitions(CGAL::CGAL INTERFACE CGAL_USE_GMPXX=1)
  target_link_libraries(CGAL::CGAL INTERFACE ${TACT_GMPXX} ${TACT_MPFR} ${TACT_GMP})
else()
  # Otherwise CGAL 5.5 takes quotients of Boost's integers, which do not hold every double.
  target_compile_definitions(CGAL::CGAL INTERFACE CGAL_DISABLE_GMP=1 CGAL_DO_NOT_USE_BOOST_MP=1)
endif()
