#include "engine/messages.h"

#include <new>
#include <string>

#include "engine/bodies/encloses.h"

namespace tact {

namespace {

// The text that make() returns; none where there is no memory for it.
template <class Make>
std::string text_if_there_is_room(const Make& make) {
  try {
    return make();
  } catch (const std::bad_alloc&) {
    return {};
  }
}

}  // namespace

void tell_limits(const Report& report, const Bodies& bodies, const MessageFunction& tell) {
  std::int64_t untold = report.stats().limits_reached;
  if ((untold == 0 && report.stats().point_limits_reached == 0) || !tell) return;
  for (const Contact& contact : report.contacts()) {
    const auto tell_of = [&](MessageKind kind, const auto& words) {
      const std::string text = text_if_there_is_room([&] { return words(bodies.at(contact.a).name); });
      tell({.kind = kind, .a = contact.a, .b = contact.b, .text = text});
    };
    if (contact.limit_reached) {
      --untold;
      tell_of(MessageKind::direction_limit, [&](const std::string& a) {
        return "body '" + a + "' and body '" + bodies.at(contact.b).name +
               "': the search for their direction stopped at a limit after " + std::to_string(contact.iterations) +
               " iterations; it is the best that was found";
      });
    }
    if (contact.point_limit_reached) {
      tell_of(MessageKind::point_limit, [](const std::string& a) {
        return "body '" + a + "' crosses itself deeper than the edges that cross it are long: vertices have no point";
      });
    }
  }
  if (untold <= 0) return;
  const std::string text = text_if_there_is_room([&] {
    return std::to_string(untold) + (untold == 1 ? " pair" : " pairs") +
           " whose hulls are apart: GJK stopped at its limit";
  });
  tell({.kind = MessageKind::gjk_limit, .a = {}, .b = {}, .text = text});
}

void tell_wrong_surface(const Body& body, const MessageFunction& tell) {
  if (body.surface != Surface::closed || !tell) return;
  const auto tell_of = [&](MessageKind kind, const char* words) {
    const std::string text = text_if_there_is_room([&] { return "body '" + body.name + "' " + words; });
    tell({.kind = kind, .a = body.id, .b = body.id, .text = text});
  };
  if (!body.has_inside) {
    tell_of(MessageKind::open_surface,
            "was added as closed and is taken as a sheet: its surface has a border, facets turned against each other, "
            "or each facet twice, once each way");
  } else if (!body.is_outward && is_inside_out(body.mesh)) {
    tell_of(MessageKind::inside_out,
            "is inside out: its facets are clockwise seen from outside, so most of its negative gaps are missing; "
            "exchange two corners of each facet");
  }
}

}  // namespace tact
