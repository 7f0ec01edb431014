#include "mpi/program/pile_file.h"

#include <fmt/format.h>

#include <cmath>

#include "scenes/commands/json_text.h"
#include "scenes/dynamics/free_way.h"

namespace tact::mpi::program {
namespace {

using scenes::Json;

Json number_or_null(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json array_of(Vec3 p) { return Json::array({p.x, p.y, p.z}); }

Json body_json(std::uint64_t key, const Body& body, Vertices vertices) {
  Vec3 sum;
  for (const Vec3& p : body.positions) sum = sum + p;
  Json json = {{"key", key},
               {"name", body.name},
               {"asleep", body.asleep},
               {"middle", array_of((1.0 / static_cast<double>(body.positions.size())) * sum)}};
  if (vertices == Vertices::left_out) return json;
  Json& all = json["positions"] = Json::array();
  for (const Vec3& p : body.positions) all.insert(all.end(), {p.x, p.y, p.z});
  return json;
}

Json pair_json(const Contact& contact) {
  const tact::Contact& found = contact.contact;
  return {{"a", contact.bodies.key_a},
          {"b", contact.bodies.key_b},
          {"touching", found.touching()},
          {"facet_pairs", found.facet_pairs().size()},
          {"points", found.points().size()},
          {"gap", number_or_null(scenes::smallest_gap(found.points()))},
          {"hash", fmt::format("{:016x}", found.hash())}};
}

std::string head_of(int frame, const PileState& state) {
  const Json head = {{"frame", frame},
                     {"time", state.time},
                     {"kinetic_energy", state.kinetic_energy},
                     {"awake", state.awake},
                     {"asleep", state.asleep},
                     {"contacts", state.contacts},
                     {"contact_points", state.contact_points},
                     {"facet_pairs", state.facet_pairs},
                     {"detections", state.detections},
                     {"smallest_gap", number_or_null(state.smallest_gap)}};
  std::string text = scenes::json_text(head);
  text.pop_back();  // the object goes on
  return text + ",\"bodies\":[\n";
}

}  // namespace

void append_frame(OrderedFile& file, int frame, const PileSimulation& pile, Vertices vertices) {
  file.append(head_of(frame, pile.state()));
  std::vector<Piece> bodies, pairs;
  for (std::size_t i = 0; i < pile.keys().size(); ++i) {
    const std::uint64_t key = pile.keys()[i];
    bodies.push_back({{key, 0}, scenes::json_text(body_json(key, pile.bodies()[i], vertices))});
  }
  file.append(std::move(bodies), ",\n");
  file.append("\n],\"pairs\":[\n");
  for (const Contact& contact : pile.report().contacts()) {
    if (contact.bodies.counted)
      pairs.push_back({{contact.bodies.key_a, contact.bodies.key_b}, scenes::json_text(pair_json(contact))});
  }
  file.append(std::move(pairs), ",\n");
  file.append("\n]}\n");
}

}  // namespace tact::mpi::program
