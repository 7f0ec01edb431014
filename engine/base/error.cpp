#include <tact/error.h>

namespace tact {

const char* error_code_name(ErrorCode code) {
  switch (code) {
    case ErrorCode::non_finite_position: return "non_finite_position";
    case ErrorCode::position_out_of_range: return "position_out_of_range";
    case ErrorCode::facet_out_of_range: return "facet_out_of_range";
    case ErrorCode::wrong_size: return "wrong_size";
    case ErrorCode::too_large: return "too_large";
    case ErrorCode::stale_body: return "stale_body";
    case ErrorCode::foreign_body: return "foreign_body";
    case ErrorCode::fixed_body: return "fixed_body";
    case ErrorCode::bad_settings: return "bad_settings";
    case ErrorCode::wrong_order: return "wrong_order";
    case ErrorCode::out_of_memory: return "out_of_memory";
    case ErrorCode::backend_failure: return "backend_failure";
    case ErrorCode::bad_recording: return "bad_recording";
    case ErrorCode::wrong_motion: return "wrong_motion";
    case ErrorCode::not_a_rotation: return "not_a_rotation";
    case ErrorCode::invalid_argument: return "invalid_argument";
    case ErrorCode::bad_state: return "bad_state";
  }
  return "unknown";
}

}  // namespace tact
