#----------------------------------------------------------------
# Generated CMake target import file for configuration "Release".
#----------------------------------------------------------------

# Commands may need to know the format version.
set(CMAKE_IMPORT_FILE_VERSION 1)

# Import target "tact::tact" for configuration "Release"
set_property(TARGET tact::tact APPEND PROPERTY IMPORTED_CONFIGURATIONS RELEASE)
set_target_properties(tact::tact PROPERTIES
  IMPORTED_LINK_INTERFACE_LANGUAGES_RELEASE "CXX"
  IMPORTED_LOCATION_RELEASE "${_IMPORT_PREFIX}/lib/libtact.a"
  )

list(APPEND _cmake_import_check_targets tact::tact )
list(APPEND _cmake_import_check_files_for_tact::tact "${_IMPORT_PREFIX}/lib/libtact.a" )

# Commands beyond this point should not need to know the version.
set(CMAKE_IMPORT_FILE_VERSION)
