// The version of tact, as semantic versioning has it. CMake reads it from here.
#pragma once

#define TACT_VERSION_MAJOR 0
#define TACT_VERSION_MINOR 1
#define TACT_VERSION_PATCH 0
#define TACT_VERSION "0.1.0"
