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
    {"everything", everything, {0x23b2383b90bc8d06, 0x88be0c076ea6a8cb, 0x2da58fb87c249f8c}},
    {"surgery", surgery, {0x77997138121fdaff, 0xe7488da143c14c84, 0x940e0e4a8141c8f5}},
    {"as_in_the_paper", as_in_the_paper, {0x7e43618e08008598, 0x3700745f7c7ebc4b, 0xfc3e8592dac366cb}},
    {"hulls_alone", hulls_alone, {0xc9d4f7a4a0389528, 0x41f80414c23f4714, 0xa6c0dc80fab03bc2}},
    {"wall", wall, {0x0c6eb35572444384, 0x9e6d15c0a91a0336, 0x37cf5f49c603ea96}},
    {"large", large, {0x3590805f1b5293f3, 0x25b10be5e2ffb539, 0xe5c0571f6aa85dca}},
    {"gaps", play_gaps, {0x7625473f5bdeeb8d, 0x90a4ef45c832a9a8, 0x4857829cb7dd64c8}},
    {"crossings", play_crossings, {0x4cc57f0f757ce3d9, 0x0ba538f3e4a91847, 0x1e583d4e5e5ca357}},
    {"stacked_sheets", play_stacked_sheets, {0xaea09c5b16a99730, 0x975352ccae05787a, 0x66e6becbf8827a21}},
    {"parallel_edges", play_parallel_edges, {0x62ade81c391a31ef, 0x2b3ee80525dc9674, 0xc21ded66a9420641}},
    {"cut_sheets", play_cut_sheets, {0x67f0b38a243e8e46, 0x93609662437e5c86, 0x90d42aed81bc99c1}},
    {"nested", play_nested, {0x154faf416e225c3d, 0x884b796ccbffd161, 0xc0bfd00a3e22b015}},
    {"degenerate", play_degenerate, {0x42e48782229530b1, 0xa232d07f7c1770b7, 0xe24a3c124e9ab8fb}},
    {"many_clusters", play_many_clusters, {0x94c71db2c4ae80e7, 0xba8cb83172f68529, 0xb9a319e525e1999b}},
    {"cluster_trees", play_cluster_trees, {0xe5a0c064ba9fd125, 0x6d43d1629e08c4bc, 0x97d55fe7e912c454}},
    {"curves", play_curves, {0x69f7cf5106268157, 0x2e4d6e22a78c505d, 0xea5753b571530ca4}},
    {"self_sheets", play_self_sheets, {0x08e17dace0ca5ad2, 0x9318fedf4bcd5861, 0x306bbce7899a658d}},
    {"self_closed", play_self_closed, {0x2dd5e711cb33242f, 0x314fa0ae6fb2f931, 0x6b9ef1c67a5b5a53}},
    {"self_facets", play_self_facets, {0x9a552030599ec92f, 0x66849b5d091bdad5, 0x9beb00624624a329}},
    {"self_large", play_self_large, {0xe4445769b752d988, 0x5a9e816a5dec8af6, 0x08e1799353e210cb}},
    {"impacts", play_impacts, {0x79fe92e72a420b61, 0x5bd9f0e2a8243ab9, 0x281c330fd216d472}},
    {"impacts_of_cloth", play_impacts_of_cloth, {0x71dbf15bc518c10d, 0xfcaecbd615efde7a, 0x0bf2097feeda140e}},
    {"first_impacts", play_first_impacts, {0xd701d096bffb2928, 0xfde833af67331dd8, 0xd7399c245f70254f}},
    {"impacts_large", play_impacts_large, {0x81650dd764ba98d8, 0xbdee4915b8bbf100, 0xbd4d102e550ed59d}},
    {"poses", play_poses, {0xf20f73c15b75aeef, 0x98d0d573677761de, 0x3e242dcc552f7881}},
    {"patches", play_patches, {0xec125954bc978393, 0x83c58bc9c3bc3c77, 0x205ea442d524b878}},
    {"patches_of_facets", play_patches_of_facets, {0xa4d80bed9f6d95e5, 0x2b272ce5d05cab69, 0xd02f0422b86b6cfe}},
    {"clamp", play_clamp, {0x99ad93e7c71ebb54, 0x857a425cc4fd3084, 0x364332450cf7c9f8}},
    {"calls", play_calls, {0x2a85ba9b6439887d, 0xf4364b9b574a10c2, 0x7e55e590cf64b6bf}},
    {"rays", play_rays, {0x0d82f994797a6870, 0x60fa170f2172374b, 0x412e1bd33b074d44}},
    {"closest_points", play_closest_points, {0x713a500a470a7034, 0xcdd91392accc4a25, 0x1e127fe0376bb8d4}},
    {"boxes", play_boxes, {0x8d60221edbf116cf, 0xd2c8721bd83262c6, 0x6cfaf97b17f96814}},
    {"inside", play_inside, {0x7f0c935580d9d901, 0x960b7f90a92c88a3, 0x387197bb83336c85}},
    {"touching", play_touching, {0x174514ccf7d1b7c1, 0x91ec7666114fc7f7, 0x9b3546a0582b4975}},
    {"touching_bare", play_touching_bare, {0x5e3682ec1cf78403, 0x06df1c80c75cf8c9, 0x4fab63eea5a3acbd}},
    {"self_touching", play_self_touching, {0xf5f708977983c50f, 0xb92dd033b07a4fef, 0xc87b69fded5c78c3}},
    {"query_ties", play_query_ties, {0x0000000000000000, 0x8898f8fd925f0950, 0x4c6fee9e12fedb3e}},
    {"bare", play_bare, {0xd353c977a0b93971, 0xc4762bf8b161974e, 0xb8149f93b78fead5}},
    {"planes", play_planes, {0xe97db1769b969720, 0xdf8d588b7fe1d64f, 0xd636c5a270e30210}},
    {"many_bodies", play_many_bodies, {0x33d3764fdccfb06e, 0x3d385597c9e1e60b, 0x114c433d0476456c}},
};

}  // namespace

std::span<const HashScene> hash_scenes() { return kScenes; }

}  // namespace tact::tests
