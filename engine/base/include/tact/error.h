// What tact throws when it is given bad data. The world is then exactly as it was before the call (of
// World::detect() see there).
#pragma once

#include <stdexcept>
#include <string>

#if defined(TACT_SHARED)
#define TACT_API __attribute__((visibility("default")))
#else
#define TACT_API
#endif

namespace tact {

/// What was wrong with what the program gave.
enum class ErrorCode {
  non_finite_position,    ///< a coordinate is NaN or infinite
  position_out_of_range,  ///< a coordinate is larger than kLargestCoordinate in size
  facet_out_of_range,     ///< a facet names a vertex that the body does not have
  wrong_size,             ///< a matrix is not 3 x N, or the number of positions is not the body's of vertices
  too_large,              ///< more than 2^29 - 1 vertices or facets, or 2^32 - 1 bodies
  stale_body,             ///< the id is of a body that was removed, or was never given out
  foreign_body,           ///< the id was given out by another world
  fixed_body,             ///< positions or a pose were set on a body whose motion is fixed
  bad_settings,           ///< a setting has no meaning; the message says which
  wrong_order,            ///< a call of a world that was moved from, or a body named twice in one batch
  out_of_memory,          ///< an allocation failed, ours or Embree's
  backend_failure,        ///< Embree reported an error; the message holds its code
  bad_recording,          ///< bytes that are no recording, or one that does not play; the message says at which byte
  wrong_motion,           ///< positions were set on a rigid body, or a pose on one that is not
  not_a_rotation,         ///< the matrix of a pose turns nothing: it is not orthonormal to 1e-9, or mirrors
  invalid_argument,       ///< an argument has no meaning, such as an unknown enumeration value or a negative margin
};

/// The name of `code` as it stands in the enumeration, such as "stale_body".
TACT_API const char* error_code_name(ErrorCode code);

/// The exception of every public function. `what()` names the body, vertex, facet or setting; of out_of_memory it is
/// empty if there was no memory for a message.
class TACT_API Error : public std::runtime_error {
 public:
  /// `message` tells what was wrong, for a person.
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// For a program.
  ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace tact
