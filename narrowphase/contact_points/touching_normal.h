// The normal where a vertex touches a surface in an edge or a vertex, which several facets have.
#pragma once

#include <span>

#include "narrowphase/contact_points/scaled_mesh.h"

namespace tact::narrowphase {

enum class Turned { as_it_is, either_way };

/// Of the facets that have the feature's vertices, by the mesh's numbers, the unit normal that leads most along
/// `along`; of equal ones that of the caller's first. Zero if none has an area.
Vec3 touching_normal(const ScaledMesh& surface, std::span<const int> feature, Vec3 along, Turned turned);

}  // namespace tact::narrowphase
