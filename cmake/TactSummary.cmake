# One line at the end of a configuration: what is built, and what would be on request.
set(kind static)
if(BUILD_SHARED_LIBS)
  set(kind shared)
endif()
message(STATUS "tact ${PROJECT_VERSION}: ${kind} library; TACT_BUILD_PROGRAM=${TACT_BUILD_PROGRAM}, "
               "TACT_BUILD_PYTHON=${TACT_BUILD_PYTHON}, TACT_BUILD_TESTS=${TACT_BUILD_TESTS}, "
               "TACT_BUILD_BENCH=${TACT_BUILD_BENCH}; Embree: ${TACT_USES_EMBREE}, OpenMP: ${TACT_USES_OPENMP}, MPI: ${TACT_USES_MPI}")
