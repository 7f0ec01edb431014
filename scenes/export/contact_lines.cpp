#include "scenes/export/contact_lines.h"

#include <utility>

#include "scenes/commands/json_text.h"
#include "scenes/commands/report_json.h"

namespace tact::scenes {
namespace {

Json contact_json(const World& world, const Contact& contact) {
  Json pairs = Json::array();
  for (const FacetPair& pair : contact.facet_pairs()) pairs.push_back(Json::array({pair.a, pair.b}));
  const Eigen::Vector3d& n = contact.direction;
  return {{"a", contact.a.index},
          {"b", contact.b.index},
          {"names", Json::array({world.name(contact.a), world.name(contact.b)})},
          {"direction", Json::array({n.x(), n.y(), n.z()})},
          {"depth", contact.depth},
          {"source", direction_source_name(contact.source)},
          {"facet_pairs", std::move(pairs)}};
}

}  // namespace

void write_contact_line(std::ostream& out, int frame, double time, const World& world, const Report& report) {
  Json contacts = Json::array();
  for (const Contact& contact : report.contacts()) contacts.push_back(contact_json(world, contact));
  const Json line = {{"frame", frame}, {"time", time}, {"contacts", std::move(contacts)}};
  out << json_text(line) << '\n';
}

}  // namespace tact::scenes
