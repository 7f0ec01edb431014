# What package managers take: the file of pkg-config, the Debian packages, the target `uninstall`.

set(TACT_PC_LIBDIR ${CMAKE_INSTALL_FULL_LIBDIR})
set(TACT_PC_INCLUDEDIR ${CMAKE_INSTALL_FULL_INCLUDEDIR})
if(BUILD_SHARED_LIBS)
  set(TACT_PC_DEFINITIONS " -DTACT_SHARED")
else()
  set(TACT_PC_STATIC_LIBS "${OpenMP_CXX_FLAGS} -lstdc++ -lm")
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/tact.pc.in ${PROJECT_BINARY_DIR}/tact.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/tact.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)

add_custom_target(uninstall COMMENT "Removing what was installed"
  COMMAND ${CMAKE_COMMAND} -DMANIFEST_FOLDER=${PROJECT_BINARY_DIR} -P ${PROJECT_SOURCE_DIR}/cmake/uninstall.cmake)

# Debian: libtact and the number of its SONAME, as Debian wants it, the shared library; libtact-dev, headers and how to find them; tact-tools, the program;
# python3-tact, the package for Python. From a shared build, as any library of Debian: `cmake --preset packages &&
# cmake --build --preset packages && cpack --config build/packages/CPackConfig.cmake`.
get_target_property(soversion tact SOVERSION)
set(runtime_package libtact${soversion})
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME tact)
set(CPACK_PACKAGE_CONTACT "The maintainers of tact <maintainers@tact.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/engine)  # where the others find libtact
set(CPACK_COMPONENTS_ALL runtime library)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${runtime_package})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libtact-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "${runtime_package} (= ${PROJECT_VERSION}), libeigen3-dev (>= 3.4)")
if(TARGET tact_program)
  list(APPEND CPACK_COMPONENTS_ALL program)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME tact-tools)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${runtime_package} (= ${PROJECT_VERSION})")
endif()
if(TARGET tact_python)
  find_package(Python3 COMPONENTS Interpreter)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  list(APPEND CPACK_COMPONENTS_ALL python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-tact)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${runtime_package} (= ${PROJECT_VERSION}), python3-numpy, \
python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor})")
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/bindings/blender/tact_blender DESTINATION share/blender/scripts/addons
    COMPONENT blender FILES_MATCHING PATTERN "*.py")
  list(APPEND CPACK_COMPONENTS_ALL blender)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_NAME blender-tact)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_BLENDER_PACKAGE_DEPENDS "python3-tact (= ${PROJECT_VERSION}), blender (>= 3.4)")
endif()
include(CPack)
