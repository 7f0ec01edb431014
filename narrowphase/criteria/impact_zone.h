// The part of a mesh between the contact planes, projected along the contact direction (paper §3, §4.4).
#pragma once

#include <vector>

#include "narrowphase/criteria/smallest_enclosing_disk.h"
#include "narrowphase/mesh/clustered_mesh.h"

namespace tact::narrowphase {

// The space between the contact planes: lower <= n · (x - origin) <= upper, in metres.
struct Slab {
  Vec3 n;  // unit, from A to B
  Vec3 u;  // unit; (u, v, n) is a right-handed orthonormal frame
  Vec3 v;
  Vec3 origin;
  double lower = 0.0;  // l_B(n) as computed by support queries about `origin`
  double upper = 0.0;  // h_A(n)
  double error = 0.0;  // bounds the rounding of n · (x - origin), u · and v · for every vertex x of either mesh, metres
};

// A slab whose u and v follow from n by a fixed rule.
Slab make_slab(Vec3 n, Vec3 origin, double lower, double upper, double error);

// A disk in the plane of u and v about the slab's origin, metres.
struct ImpactZone {
  Disk disk;  // holds the projection of every point of the mesh in the slab, but for rounding; no disk if there is none
  double error = 0.0;  // bounds that rounding: the true zone lies within disk.radius + error of disk.center
};

// The *true zone* is the set of (u · (x - origin), v · (x - origin)), in real arithmetic, of all points x of the mesh's
// facets with lower - error <= n · (x - origin) <= upper + error. It lies within disk.radius + error of disk.center; if
// there is no disk it is empty. The disk is the smallest around the projection of the mesh between planes that are
// wider by twice the slab's error.
//
// Facets are clipped, crossing edges included: a facet may cross the slab with all its corners outside. Clusters
// outside the slab are not opened; the work is linear in the facets of the rest. The answer depends on the facets
// alone, not on their order nor on their clusters. `scratch` is reused between calls.
ImpactZone impact_zone(const ClusteredMesh& mesh, const Slab& slab, std::vector<Point2>& scratch);

}  // namespace tact::narrowphase
