#include "scenes/pictures/contact_marks.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>

namespace tact::scenes {
namespace {

double diagonal(const PictureBody& body) {
  return (body.positions.rowwise().maxCoeff() - body.positions.rowwise().minCoeff()).norm();
}

bool meets(const Contact& contact) { return !contact.facet_pairs().empty() || !contact.points().empty(); }

// The middle of the box around the facets and points of `body`, a of the contact, that meet, or around all of it if
// none does.
Eigen::Vector3d meeting_place(const PictureBody& body, const Contact& contact) {
  Eigen::AlignedBox3d box;
  if (!meets(contact)) {
    return 0.5 * (body.positions.rowwise().minCoeff() + body.positions.rowwise().maxCoeff());
  }
  for (const ContactPoint& point : contact.points()) {
    for (const int v : point.a_vertices) {
      if (v >= 0) box.extend(body.positions.col(v));
    }
  }
  for (const FacetPair& pair : contact.facet_pairs()) {
    for (int k = 0; k < 3; ++k) box.extend(body.positions.col(body.facets(k, pair.a)));
  }
  return box.center();
}

template <class Value>
void sort_unique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

// The facets of a body that hold one of some features: vertices, edges or facets.
class FacetsOfFeatures {
 public:
  void add(const std::array<int, 3>& vertices) { features_.push_back(vertices); }
  void append_to(std::vector<int>& facets, const Eigen::Matrix3Xi& all) {
    if (features_.empty()) return;
    sort_unique(features_);
    for (int f = 0; f < static_cast<int>(all.cols()); ++f) {
      if (holds_one(all.col(f))) facets.push_back(f);
    }
  }

 private:
  bool holds_one(const Eigen::Vector3i& facet) const {
    const auto has = [&](int vertex) { return vertex < 0 || (facet.array() == vertex).any(); };
    for (const int corner : facet) {
      const auto first = std::ranges::lower_bound(features_, corner, {}, [](const auto& one) { return one[0]; });
      for (auto one = first; one != features_.end() && (*one)[0] == corner; ++one) {
        if (has((*one)[1]) && has((*one)[2])) return true;
      }
    }
    return false;
  }

  std::vector<std::array<int, 3>> features_;
};

// The facets on which contact points lie.
void mark_points(PictureScene& scene, const Report& report) {
  std::vector<FacetsOfFeatures> features(scene.bodies.size());
  for (const Contact& contact : report.contacts()) {
    if (contact.a.index >= features.size() || contact.b.index >= features.size()) continue;
    for (const ContactPoint& point : contact.points()) {
      features[contact.a.index].add(point.a_vertices);
      features[contact.b.index].add(point.b_vertices);
    }
  }
  for (std::size_t i = 0; i < features.size(); ++i)
    features[i].append_to(scene.bodies[i].meeting_facets, scene.bodies[i].facets);
}

}  // namespace

void mark_contacts(PictureScene& scene, const Report& report, const ContactMarks& marks) {
  for (const Contact& contact : report.contacts()) {
    if (contact.a.index >= scene.bodies.size() || contact.b.index >= scene.bodies.size()) continue;
    PictureBody& a = scene.bodies[contact.a.index];
    PictureBody& b = scene.bodies[contact.b.index];
    if (a.positions.cols() == 0 || b.positions.cols() == 0) continue;  // a plane
    if (marks.facets) {
      for (const FacetPair& pair : contact.facet_pairs()) {
        a.meeting_facets.push_back(pair.a);
        b.meeting_facets.push_back(pair.b);
      }
    }
    if (marks.directions && contact.a != contact.b && (marks.hulls || meets(contact))) {
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
  if (marks.facets) mark_points(scene, report);
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
