/// Messages of a world: see Settings::on_message.
#pragma once

#include <tact/body.h>

#include <functional>
#include <string_view>

namespace tact {

/// What a message is about.
enum class MessageKind {
  direction_limit,  ///< the search for the direction of a contact stopped at a limit
  gjk_limit,        ///< GJK stopped at its limit for pairs that are taken to be apart
  point_limit,      ///< a body crosses itself deeper than its points are found
  open_surface,     ///< a body was added as closed, and is taken as a sheet
  inside_out,       ///< a closed body was added whose facets are clockwise seen from outside
};

/// A limit that a step reached, or what is wrong with a body that was added.
struct Message {
  MessageKind kind = MessageKind::direction_limit;
  BodyId a;               ///< the first body of the pair, or no body
  BodyId b;               ///< the second body of the pair, or no body
  std::string_view text;  ///< a sentence with the names of the bodies; valid during the call, empty without memory
};

/// Called at the end of World::detect(), in the order of the pairs, and in World::add_body(), before the body is added,
/// on their thread. It must not call the world. What it throws comes out of the call: detect() has made its step then,
/// and add_body() has changed nothing.
using MessageFunction = std::function<void(const Message&)>;

}  // namespace tact
