#include "engine/messages.h"

#include <string>

namespace tact {

void tell_limits(const Report& report, const Bodies& bodies, const MessageFunction& tell) {
  std::int64_t untold = report.stats().limits_reached;
  if (untold == 0 || !tell) return;
  for (const Contact& contact : report.contacts()) {
    if (!contact.limit_reached) continue;
    --untold;
    const std::string text = "body '" + bodies.at(contact.a).name + "' and body '" + bodies.at(contact.b).name +
                             "': the search for their direction stopped at a limit after " +
                             std::to_string(contact.iterations) + " iterations; it is the best that was found";
    tell({.kind = MessageKind::direction_limit, .a = contact.a, .b = contact.b, .text = text});
  }
  if (untold <= 0) return;
  const std::string text =
      std::to_string(untold) + (untold == 1 ? " pair" : " pairs") + " whose hulls are apart: GJK stopped at its limit";
  tell({.kind = MessageKind::gjk_limit, .a = {}, .b = {}, .text = text});
}

}  // namespace tact
