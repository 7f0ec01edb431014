#include "tests/support/hashes/hash_scenes.h"

#include <span>
#include <vector>

#include "tests/support/generators/bodies.h"
#include "tests/support/generators/body_pairs.h"
#include "tests/support/hashes/hash_scene_list.h"
#include "tests/support/hashes/scene_player.h"

namespace tact::tests {
namespace {

// Steps over `bodies`, all of which drift and tremble, and a few of which stand still in each step.
SceneHashes play(std::span<const Mesh> bodies, const Settings& settings, int steps, double speed) {
  ScenePlayer player(settings);
  for (const Mesh& body : bodies) player.add({.mesh = body});
  Random random(bodies.size());
  for (int step = 0; step < steps; ++step) {
    player.step();
    player.drift(speed, random);
  }
  return player.hashes();
}

SceneHashes crowd(int threads) { return play(crowd_of_blobs(60, 1), {.threads = threads}, 6, 0.1); }

SceneHashes everything(int threads) {
  const Settings settings{
      .threads = threads, .direction = DirectionPolicy::smallest, .outputs = {.zones = true, .patches = true}};
  return play(mixed_crowd(40, 1), settings, 4, 0.05);
}

SceneHashes surgery(int threads) {
  const std::vector<Mesh> bodies = {organ(1), translated(tool(), {0.1, 0.0, 0.1}), wrinkled_sheet(20, 1.5, 0.3, 1)};
  return play(bodies, {.threads = threads, .outputs = {.zones = true}}, 12, 0.02);
}

SceneHashes as_in_the_paper(int threads) {
  return play(crowd_of_blobs(30, 2), {.threads = threads, .accuracy = Accuracy::paper}, 4, 0.1);
}

SceneHashes hulls_alone(int threads) {
  return play(crowd_of_blobs(60, 3), {.threads = threads, .accuracy = Accuracy::hulls}, 4, 0.1);
}

SceneHashes wall(int threads) { return play(brick_wall(6, 10), {.threads = threads}, 2, 0.0); }

// Bodies so large that one pair is shared out among the threads, and sheets of so many clusters that trees find their
// pairs.
SceneHashes large(int threads) {
  const std::vector<Mesh> bodies = {soup(12000, 1.0, 1), soup(10000, 1.0, 2), wrinkled_sheet(190, 2.0, 0.02, 3),
                                    wrinkled_sheet(190, 2.0, 0.02, 4)};
  return play(bodies, {.threads = threads}, 2, 0.01);
}

constexpr HashScene kScenes[] = {
    {"crowd", crowd, {0x93538d9c4ec3cc4b, 0x271d56502165e527, 0x34a12a61384a9bd5}},
    {"everything", everything, {0x23b2383b90bc8d06, 0x88be0c076ea6a8cb, 0x5c425457e9dd823b}},
    {"surgery", surgery, {0x77997138121fdaff, 0xe7488da143c14c84, 0x940e0e4a8141c8f5}},
    {"as_in_the_paper", as_in_the_paper, {0x7e43618e08008598, 0x3700745f7c7ebc4b, 0xfc3e8592dac366cb}},
    {"hulls_alone", hulls_alone, {0xc9d4f7a4a0389528, 0x41f80414c23f4714, 0xa6c0dc80fab03bc2}},
    {"wall", wall, {0x0c6eb35572444384, 0x9e6d15c0a91a0336, 0x37cf5f49c603ea96}},
    {"large", large, {0x3590805f1b5293f3, 0x25b10be5e2ffb539, 0xe5c0571f6aa85dca}},
    {"gaps", play_gaps, {0x226da8b997b92c69, 0x5e563925b16bf8cf, 0x1a6aa0815526bdbe}},
    {"crossings", play_crossings, {0x83c2db21688a19e2, 0x12082b19694e5103, 0x2a6b0710466f3a1d}},
    {"stacked_sheets", play_stacked_sheets, {0xaea09c5b16a99730, 0x975352ccae05787a, 0xfdc7e4625bb26b5e}},
    {"parallel_edges", play_parallel_edges, {0xb73af5575e4efb67, 0x8c2ee55acee4d18a, 0x3db90c7749d0853e}},
    {"cut_sheets", play_cut_sheets, {0x67f0b38a243e8e46, 0x93609662437e5c86, 0xd92ce6203d1100d4}},
    {"nested", play_nested, {0x9ab273ab33390625, 0x9353644c8273d2d5, 0x7ab3e4a7d5b684c2}},
    {"degenerate", play_degenerate, {0x52c25d7c33d16c3b, 0xfb81b9f65bd524ef, 0x143e0ac9a8a8c492}},
    {"many_clusters", play_many_clusters, {0x94c71db2c4ae80e7, 0xba8cb83172f68529, 0x432acad1301454d2}},
    {"cluster_trees", play_cluster_trees, {0xe5a0c064ba9fd125, 0x6d43d1629e08c4bc, 0xcf71da5e5d6701c5}},
    {"self_sheets", play_self_sheets, {0xc6feb9a909ed6ae2, 0xa4c906855f5472e4, 0x70cf96b6a5f50bec}},
    {"self_closed", play_self_closed, {0x7058423d977d45ec, 0xdd0c6b5b8cca1dad, 0xc8f41eeeba013313}},
    {"self_facets", play_self_facets, {0x9a552030599ec92f, 0x66849b5d091bdad5, 0x4cf6b8f815b4a0f3}},
    {"self_large", play_self_large, {0xe4445769b752d988, 0x5a9e816a5dec8af6, 0x08e1799353e210cb}},
    {"impacts", play_impacts, {0x79fe92e72a420b61, 0xb4e084cd7090c182, 0x281c330fd216d472}},
    {"impacts_of_cloth", play_impacts_of_cloth, {0x71dbf15bc518c10d, 0xfcaecbd615efde7a, 0x0bf2097feeda140e}},
    {"first_impacts", play_first_impacts, {0xd701d096bffb2928, 0xfde833af67331dd8, 0xd7399c245f70254f}},
    {"impacts_large", play_impacts_large, {0x81650dd764ba98d8, 0xbdee4915b8bbf100, 0xbd4d102e550ed59d}},
    {"poses", play_poses, {0x1d7c1466464a3dcb, 0x26cfcd8f9d008ffb, 0xd53e020bb32fa38c}},
    {"patches", play_patches, {0xe51f1800318dc020, 0xe02a6e1acb2c5a09, 0x36b81780638075f0}},
    {"patches_of_facets", play_patches_of_facets, {0xa4d80bed9f6d95e5, 0x2b272ce5d05cab69, 0xd02f0422b86b6cfe}},
    {"clamp", play_clamp, {0xdfe382b4f6d19895, 0x8e21b3d7ed0a67c5, 0x6a445c6bb493fd19}},
    {"calls", play_calls, {0xc4a393ffb17c00ce, 0xe320b35f6cb22838, 0x90f9bc4174a10d2f}},
    {"rays", play_rays, {0x0d82f994797a6870, 0x60fa170f2172374b, 0xb95846adf4887883}},
    {"closest_points", play_closest_points, {0x713a500a470a7034, 0xcdd91392accc4a25, 0x1e127fe0376bb8d4}},
    {"boxes", play_boxes, {0x8d60221edbf116cf, 0xd2c8721bd83262c6, 0x6cfaf97b17f96814}},
    {"inside", play_inside, {0x7f0c935580d9d901, 0xe15d9007a8d245fb, 0x387197bb83336c85}},
    {"touching", play_touching, {0x0916adbe94d3d6d8, 0xe9ced77310959ae0, 0x98b539c13a799a64}},
    {"touching_bare", play_touching_bare, {0x458ca6dcc9e225a3, 0xf3c00f9c5af7ec89, 0x6370564d51350f07}},
    {"self_touching", play_self_touching, {0xf5f708977983c50f, 0xb92dd033b07a4fef, 0x9a32e4dff430a3fb}},
    {"query_ties", play_query_ties, {0x0000000000000000, 0x8898f8fd925f0950, 0x5012d5e3fa0ebbee}},
    {"many_bodies", play_many_bodies, {0xdd0df304ac8d4217, 0x4a990dfc1997eb97, 0x3159dc20985138cd}},
};

}  // namespace

std::span<const HashScene> hash_scenes() { return kScenes; }

}  // namespace tact::tests
