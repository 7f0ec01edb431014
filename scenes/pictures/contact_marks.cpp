#include "scenes/pictures/contact_marks.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace tact::scenes {
namespace {

double diagonal(const PictureBody& body) {
  return (body.positions.rowwise().maxCoeff() - body.positions.rowwise().minCoeff()).norm();
}

// The middle of the box around the facets of `body` that meet, or around all of it if none does.
Eigen::Vector3d meeting_place(const PictureBody& body, const Contact& contact) {
  Eigen::AlignedBox3d box;
  if (!contact.touching()) {
    return 0.5 * (body.positions.rowwise().minCoeff() + body.positions.rowwise().maxCoeff());
  }
  for (const FacetPair& pair : contact.facet_pairs()) {
    for (int k = 0; k < 3; ++k) box.extend(body.positions.col(body.facets(k, pair.a)));
  }
  return box.center();
}

void sort_unique(std::vector<int>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

}  // namespace

void mark_contacts(PictureScene& scene, const Report& report, const ContactMarks& marks) {
  for (const Contact& contact : report.contacts()) {
    if (contact.a.index >= scene.bodies.size() || contact.b.index >= scene.bodies.size()) continue;
    PictureBody& a = scene.bodies[contact.a.index];
    PictureBody& b = scene.bodies[contact.b.index];
    if (marks.facets) {
      for (const FacetPair& pair : contact.facet_pairs()) {
        a.meeting_facets.push_back(pair.a);
        b.meeting_facets.push_back(pair.b);
      }
    }
    if (marks.directions && (marks.hulls || contact.touching())) {
      const double size = std::min(diagonal(a), diagonal(b));
      scene.arrows.push_back(
          {.start = meeting_place(a, contact),
           .direction = contact.direction,
           .length = std::clamp(contact.depth, marks.shortest_arrow * size, marks.longest_arrow * size)});
    }
    if (marks.zones) {
      for (const ZoneDisk& zone : {contact.zone_a, contact.zone_b}) {
        if (zone.radius <= 0.0) continue;
        scene.disks.push_back({.center = zone.center, .normal = contact.direction, .radius = zone.radius});
      }
    }
  }
  for (PictureBody& body : scene.bodies) sort_unique(body.meeting_facets);
}

void keep_arrows_in_picture(const Camera& camera, int width, int height, PictureScene& scene) {
  const double edge = 0.02 * height;  // pixels that stay free
  const auto is_seen = [&](const Eigen::Vector3d& point) {
    const PicturePoint p = project(camera, point, width, height);
    return p.depth > 0.0 && p.x > edge && p.x < width - edge && p.y > edge && p.y < height - edge;
  };
  for (Arrow& arrow : scene.arrows) {
    for (double share = 1.0; share >= 0.1; share -= 0.05) {
      if (!is_seen(arrow.start + share * arrow.length * arrow.direction)) continue;
      arrow.length *= share;
      break;
    }
  }
}

}  // namespace tact::scenes
