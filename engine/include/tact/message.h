/// What a world says while it works: see Settings::on_message.
#pragma once

#include <tact/body.h>

#include <functional>
#include <string_view>

namespace tact {

enum class MessageKind {
  direction_limit,  ///< the search for the direction of a contact stopped at Settings::iteration_limit, or GJK at its
                    ///< own
  gjk_limit,        ///< GJK stopped at its limit for pairs that are no contacts: they are taken as GJK left them
};

struct Message {
  MessageKind kind = MessageKind::direction_limit;
  BodyId a;  ///< the pair, where it is about one; else no body
  BodyId b;
  std::string_view text;  ///< one sentence with the names of the bodies; valid during the call
};

/// Called by detect() on the thread that called it, at its end, in the order of the pairs. It must not throw, nor call
/// the world.
using MessageFunction = std::function<void(const Message&)>;

}  // namespace tact
