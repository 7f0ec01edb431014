// The scenes of hash_scenes.h, by subject: each is played with so many threads.
#pragma once

#include "tests/support/hashes/hash_scenes.h"

namespace tact::tests {

// hash_scenes_points.cpp
SceneHashes play_gaps(int threads);
SceneHashes play_crossings(int threads);
SceneHashes play_stacked_sheets(int threads);
SceneHashes play_parallel_edges(int threads);
SceneHashes play_cut_sheets(int threads);
SceneHashes play_nested(int threads);
SceneHashes play_degenerate(int threads);
SceneHashes play_many_clusters(int threads);
SceneHashes play_cluster_trees(int threads);
SceneHashes play_curves(int threads);

// hash_scenes_self.cpp
SceneHashes play_self_sheets(int threads);
SceneHashes play_self_closed(int threads);
SceneHashes play_self_facets(int threads);
SceneHashes play_self_large(int threads);

// hash_scenes_motion.cpp
SceneHashes play_impacts(int threads);
SceneHashes play_impacts_of_cloth(int threads);
SceneHashes play_first_impacts(int threads);
SceneHashes play_impacts_large(int threads);
SceneHashes play_poses(int threads);

// hash_scenes_patches.cpp
SceneHashes play_patches(int threads);
SceneHashes play_patches_of_facets(int threads);
SceneHashes play_clamp(int threads);
SceneHashes play_calls(int threads);

// hash_scenes_queries.cpp
SceneHashes play_rays(int threads);
SceneHashes play_closest_points(int threads);
SceneHashes play_boxes(int threads);
SceneHashes play_inside(int threads);

// hash_scenes_bare.cpp
SceneHashes play_bare(int threads);
SceneHashes play_planes(int threads);

// hash_scenes_borders.cpp
SceneHashes play_touching(int threads);
SceneHashes play_touching_bare(int threads);
SceneHashes play_self_touching(int threads);
SceneHashes play_query_ties(int threads);
SceneHashes play_many_bodies(int threads);

}  // namespace tact::tests
