// What tact throws when it is given bad data.
#pragma once

#include <stdexcept>
#include <string>

// What a shared library gives to others.
#if !defined(TACT_SHARED)
#define TACT_API
#elif defined(_WIN32) && defined(TACT_BUILDS_LIBRARY)
#define TACT_API __declspec(dllexport)
#elif defined(_WIN32)
#define TACT_API __declspec(dllimport)
#else
#define TACT_API __attribute__((visibility("default")))
#endif

namespace tact {

/// What was wrong with the data of a call.
enum class ErrorCode {
  non_finite_position,    ///< a coordinate is NaN or infinite
  position_out_of_range,  ///< a coordinate has a magnitude above kLargestCoordinate
  facet_out_of_range,     ///< a facet names a vertex that the body does not have
  wrong_size,             ///< a matrix or an array has the wrong size
  too_large,              ///< more than 2^29 - 1 vertices or facets, or 2^32 - 1 bodies
  stale_body,             ///< the body was removed, or never added
  foreign_body,           ///< the body is of another world
  fixed_body,             ///< positions or a pose were set on a body whose motion is fixed
  bad_settings,           ///< a setting is out of range; the message names it
  wrong_order,            ///< a call came at the wrong time, or a batch names a body twice
  out_of_memory,          ///< an allocation failed
  backend_failure,        ///< Embree reported an error; the message holds its code
  bad_recording,          ///< the bytes are no recording, or one that does not play
  wrong_motion,           ///< positions were set on a rigid body, or a pose on a deformable one
  not_a_rotation,         ///< the matrix of a pose is not orthonormal to 1e-9, or mirrors
  invalid_argument,       ///< an argument is out of range, such as a negative margin
  bad_state,              ///< the bytes are no saved state of a world, or damaged
};

/// Returns the name of `code`, such as "stale_body".
TACT_API const char* error_code_name(ErrorCode code);

/// The exception of every public function. `what()` names the body, vertex, facet, argument or setting. Without memory
/// for a message it is empty.
class TACT_API Error : public std::runtime_error {
 public:
  /// `message` says what was wrong, for a person.
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// Returns what was wrong, for a program.
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace tact
