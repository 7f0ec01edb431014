// The version of tact, as semantic versioning has it. CMake reads it from here.
#pragma once

#define TACT_VERSION_MAJOR 1
#define TACT_VERSION_MINOR 0
#define TACT_VERSION_PATCH 0
#define TACT_VERSION "1.0.0"
