#include <tact/contact_sums.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "engine/base/floating_point_mode.h"
#include "engine/base/vec3.h"
#include "engine/eigen_vectors.h"
#include "engine/mesh_copies.h"
#include "engine/with_memory.h"

namespace tact {

namespace {

using base::Vec3;

// A point as a sum sees it.
struct SeenPoint {
  const ContactPoint* point = nullptr;
  Vec3 place;         // in the middle of its two places
  Vec3 impulse;       // on b
  double sign = 1.0;  // -1 where the sum is over the body that is its a
};

// In the middle of the two places of a point.
Vec3 middle_of(MeshCopies& meshes, const Contact& contact, const ContactPoint& point) {
  const auto on_a = [&] { return meshes.positions(contact.a).place(point.a_vertices, point.a_weights); };
  const auto on_b = [&] { return meshes.positions(contact.b).place(point.b_vertices, point.b_weights); };
  // A plane has no vertices.
  const Vec3 half_way = 0.5 * point.gap * from_eigen(point.normal);
  if (point.kind == FeaturePair::vertex_plane) return on_a() + half_way;
  if (point.kind == FeaturePair::plane_vertex) return on_b() - half_way;
  return 0.5 * (on_a() + on_b());
}

// Impulses by id.
class ImpulsesById {
 public:
  explicit ImpulsesById(std::span<const PointImpulse> impulses) : sorted_(impulses.begin(), impulses.end()) {
    std::ranges::sort(sorted_, {}, &PointImpulse::id);
    const auto twice = std::ranges::adjacent_find(sorted_, {}, &PointImpulse::id);
    if (twice != sorted_.end())
      throw Error(ErrorCode::invalid_argument, "two impulses have the id " + std::to_string(twice->id));
  }
  Vec3 of(std::uint64_t id) const {
    const auto found = std::ranges::lower_bound(sorted_, id, {}, &PointImpulse::id);
    return found != sorted_.end() && found->id == id ? from_eigen(found->impulse) : Vec3{0.0, 0.0, 0.0};
  }

 private:
  std::vector<PointImpulse> sorted_;
};

class Adder {
 public:
  Adder(const World& world, std::span<const PointImpulse> impulses) : meshes_(world), impulses_(impulses) {}

  void add_contact(const Contact& contact) {
    if (contact.points().empty()) return;
    std::vector<SeenPoint> seen;
    for (const ContactPoint& point : contact.points())
      seen.push_back({&point, middle_of(meshes_, contact, point), impulses_.of(point.id)});
    const std::size_t whole = result_.sums.size();
    add({.kind = ContactSum::Kind::contact, .a = contact.a, .b = contact.b}, contact, seen);
    for (const Patch& patch : contact.patches()) {
      std::vector<SeenPoint> of_patch;
      for (const int p : patch.points) of_patch.push_back(seen[static_cast<std::size_t>(p)]);
      add({.kind = ContactSum::Kind::patch, .a = contact.a, .b = contact.b, .patch = patch.id, .area = patch.area},
          contact, of_patch);
      result_.sums[whole].area += patch.area;
    }
    remember(contact, seen, result_.sums[whole].area);
  }

  ContactSums finish() {
    for (auto& [body, of] : of_bodies_) {
      ContactSum sum{.kind = ContactSum::Kind::body, .a = body, .area = of.area};
      vertices_ = std::move(of.vertices);
      complete(sum, of.points);
    }
    std::size_t at = 0;
    for (std::size_t i = 0; i < result_.sums.size(); ++i) {
      result_.sums[i].vertices = std::span(result_.vertices).subspan(at, counts_[i]);
      at += counts_[i];
    }
    return std::move(result_);
  }

 private:
  struct OfBody {
    double area = 0.0;
    std::vector<SeenPoint> points;
    std::vector<VertexOfBody> vertices;
  };

  void add(ContactSum sum, const Contact& contact, const std::vector<SeenPoint>& seen) {
    for (const SeenPoint& one : seen) name_vertices(contact, *one.point, vertices_);
    complete(std::move(sum), seen);
  }

  static void name_vertices(const Contact& contact, const ContactPoint& point, std::vector<VertexOfBody>& into) {
    for (const int v : point.a_vertices)
      if (v >= 0) into.push_back({contact.a, v});
    for (const int v : point.b_vertices)
      if (v >= 0) into.push_back({contact.b, v});
  }

  // Fills in what the points add up to, and the vertices that stand in `vertices_`, which it empties.
  void complete(ContactSum sum, const std::vector<SeenPoint>& seen) {
    Vec3 places{0.0, 0.0, 0.0}, normals = places, force = places, moment = places;
    double gaps = 0.0;
    for (const SeenPoint& one : seen) {
      const Vec3 push = one.sign * one.impulse;
      sum.deepest_gap = std::min(sum.deepest_gap, one.point->gap);
      gaps += one.point->gap;
      places = places + one.place;
      normals = normals + one.sign * from_eigen(one.point->normal);
      force = force + push;
    }
    const double share = seen.empty() ? 0.0 : 1.0 / static_cast<double>(seen.size());
    const Vec3 center = share * places;
    for (const SeenPoint& one : seen) moment = moment + cross(one.place - center, one.sign * one.impulse);
    sum.points = static_cast<int>(seen.size());
    sum.mean_gap = share * gaps;
    sum.center = to_eigen(center);
    sum.normal = to_eigen(share * normals);
    sum.force = to_eigen(force);
    sum.torque = to_eigen(moment);
    std::ranges::sort(vertices_);
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
    counts_.push_back(vertices_.size());
    result_.vertices.insert(result_.vertices.end(), vertices_.begin(), vertices_.end());
    vertices_.clear();
    result_.sums.push_back(sum);
  }

  // Both sides of a contact; a body with itself has each of its points on either.
  void remember(const Contact& contact, const std::vector<SeenPoint>& seen, double area) {
    for (const double sign : {-1.0, 1.0}) {
      OfBody& body = of_bodies_[sign < 0.0 ? contact.a : contact.b];
      if (contact.a != contact.b || sign < 0.0) body.area += area;
      for (SeenPoint one : seen) {
        one.sign = sign;
        body.points.push_back(one);
        for (const int v : sign < 0.0 ? one.point->a_vertices : one.point->b_vertices)
          if (v >= 0) body.vertices.push_back({sign < 0.0 ? contact.a : contact.b, v});
      }
    }
  }

  MeshCopies meshes_;
  ImpulsesById impulses_;
  std::map<BodyId, OfBody> of_bodies_;
  std::vector<VertexOfBody> vertices_;  // of the sum that is made
  std::vector<std::size_t> counts_;     // of vertices of each sum
  ContactSums result_;
};

}  // namespace

ContactSums sum_contacts(const World& world, const Report& report, std::span<const PointImpulse> impulses) {
  const base::FloatingPointMode mode;
  return with_memory("summing contacts ran out of memory", [&] {
    Adder adder(world, impulses);
    for (const Contact& contact : report.contacts()) adder.add_contact(contact);
    return adder.finish();
  });
}

}  // namespace tact
