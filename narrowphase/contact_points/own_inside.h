// Whether a way from a place of a closed surface leads into the body that the surface encloses: a contact point on such
// a way runs through the body's own inside, and is none.
#pragma once

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

/// True if every facet at a feature, by the mesh's numbers (those of a facet in its own order), has `way`, a unit
/// vector, on its inner side, or level with it but for one at least. What all facets around a place have inside is
/// inside: each of them sees it (the kernel of the cone that they bound). Where facets fold back around a place, a way
/// that only some have inside may lead inside, too: it is not told.
bool leads_inside(const FeaturedMesh& m, std::span<const int> feature, Vec3 way);

}  // namespace tact::narrowphase
