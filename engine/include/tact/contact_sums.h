// What the contact points of contacts, patches and bodies add up to: gaps, areas, places, and a solver's own impulses.
#pragma once

#include <tact/report.h>
#include <tact/world.h>

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace tact {

/// A vertex of a body.
struct VertexOfBody {
  BodyId body;     ///< the body of the vertex
  int vertex = 0;  ///< counted from 0
  friend auto operator<=>(const VertexOfBody&, const VertexOfBody&) = default;
};

/// What a solver did at a contact point: an impulse in N s, or a force in N.
struct PointImpulse {
  std::uint64_t id = 0;                               ///< ContactPoint::id
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();  ///< on b; a has the opposite
};

/// The sum over the points of a contact, a patch or a body.
struct ContactSum {
  /// What a sum is over.
  enum class Kind {
    contact,  ///< two bodies, or one with itself
    patch,    ///< a patch of the contact before it
    body,     ///< all contacts of `a`; `b` is no body
  };
  Kind kind = Kind::contact;  ///< what it is over
  BodyId a = {};              ///< the first body
  BodyId b = {};              ///< the second body, which `normal` and `force` push
  std::uint64_t patch = 0;    ///< the id of the patch, or 0
  int points = 0;             ///< the number of contact points
  double area = 0.0;          ///< the areas of the patches, square metres; 0 where Outputs::patches is not set
  double deepest_gap = std::numeric_limits<double>::infinity();  ///< the smallest gap, metres; infinity without points
  double mean_gap = 0.0;                                         ///< metres
  Eigen::Vector3d center = Eigen::Vector3d::Zero();              ///< the mean place of its points, metres
  /// The mean of the normals towards `b`, or towards the body of a sum over a body; shorter than 1 where they differ.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< the sum of the impulses on `b`, or on the body
  Eigen::Vector3d torque = Eigen::Vector3d::Zero();  ///< their moment about `center`
  /// The vertices that its points name, each once, in order; a part of ContactSums::vertices.
  std::span<const VertexOfBody> vertices = {};
};

/// The sums of a step. It keeps what its spans view.
struct ContactSums {
  ContactSums() = default;
  ContactSums(ContactSums&&) = default;
  ContactSums& operator=(ContactSums&&) = default;
  /// Each contact with points, followed by its patches; then the bodies of these, in the order of their index.
  std::vector<ContactSum> sums;
  std::vector<VertexOfBody> vertices;  ///< those of all sums
};

/// Adds up the points of a world's last report, at the current positions. Points without an impulse have none; impulses
/// without a point are left out. Errors: invalid_argument (an id twice), stale_body (a body of the report was removed),
/// wrong_order (set_facets() took a vertex of a point away), out_of_memory.
TACT_API ContactSums sum_contacts(const World& world, const Report& report,
                                  std::span<const PointImpulse> impulses = {});

}  // namespace tact
