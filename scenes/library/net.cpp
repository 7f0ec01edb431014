#include <algorithm>
#include <utility>

#include "scenes/library/catalog.h"
#include "scenes/library/random.h"
#include "scenes/library/shapes.h"

namespace tact::scenes {
namespace {

// A net whose rim is held above a floor sags onto it under grains and a cloth. The grains are larger than its meshes.
struct Net {
  double side = 0.6;                             // metres
  double height = 0.06;                          // of the rim above the floor, metres
  double slack = 1.12;                           // how much longer ropes are than their way
  int layers = 2;                                // of grains
  double cloth_side = 0.34, cloth_height = 0.3;  // metres
  RopeMaterial ropes;
  GrainMaterial grains;
  ClothMaterial cloth{.density = 0.2, .bend_stiffness = 0.2, .friction = 0.6, .drag = 1.5};
  RigidMaterial floor{.friction = 0.7};
  DynamicsSettings dynamics{.time_step = 1.0 / 100.0, .substeps = 10};
};

int knot(int i, int j, int meshes) { return j * (meshes + 1) + i; }

Body make_net_body(int meshes, const Net& p) {
  std::vector<Vec3> knots;
  std::vector<std::pair<int, int>> ends;
  const double spacing = p.side / meshes;
  for (int j = 0; j <= meshes; ++j) {
    for (int i = 0; i <= meshes; ++i) {
      knots.push_back({p.slack * (spacing * i - 0.5 * p.side), p.slack * (spacing * j - 0.5 * p.side), p.height});
      if (i < meshes) ends.emplace_back(knot(i, j, meshes), knot(i + 1, j, meshes));
      if (j < meshes) ends.emplace_back(knot(i, j, meshes), knot(i, j + 1, meshes));
    }
  }
  Eigen::Matrix2Xi edges(2, std::ssize(ends));
  for (std::size_t e = 0; e < ends.size(); ++e)
    edges.col(static_cast<Eigen::Index>(e)) << ends[e].first, ends[e].second;
  Body net = make_ropes("net", std::move(knots), edges, p.ropes);
  // At rest its ropes are that long; held, it hangs from a frame that is smaller.
  for (Vec3& at : net.positions) at.x /= p.slack, at.y /= p.slack;
  for (int k = 0; k <= meshes; ++k) {
    for (const int v : {knot(k, 0, meshes), knot(k, meshes, meshes), knot(0, k, meshes), knot(meshes, k, meshes)})
      net.inverse_masses[static_cast<std::size_t>(v)] = 0.0;
  }
  return net;
}

}  // namespace

Scene make_net(int size) {
  Net p;
  const double mesh = p.side / size;
  p.grains.thickness = 0.6 * mesh;  // more than half of a mesh, less than its diagonal has room for
  p.ropes.thickness = std::min(p.ropes.thickness, 0.12 * mesh);
  Scene scene;
  scene.dynamics = p.dynamics;
  scene.view = {.azimuth = 35.0, .elevation = 28.0};
  scene.ground = 0.0;
  scene.add(make_floor("floor", {.normal = Eigen::Vector3d::UnitZ(), .offset = 0.0}, p.floor));
  scene.add(make_net_body(size, p));
  Random random(11);
  std::vector<Vec3> grains;
  const int along = std::max(2, size / 3);
  const double pitch = 2.3 * p.grains.thickness;
  for (int layer = 0; layer < p.layers; ++layer) {
    for (int k = 0; k < along * along; ++k) {
      const double x = pitch * (k % along - 0.5 * (along - 1)), y = pitch * (k / along - 0.5 * (along - 1));
      const double shake = 0.1 * p.grains.thickness;
      grains.push_back({x + random.between(0.0, shake), y + random.between(0.0, shake),
                        p.height + p.grains.thickness + 0.02 + pitch * layer});
    }
  }
  scene.add(make_grains("grains", std::move(grains), p.grains));
  const Mesh cloth = rotated(grid_sheet(2 * size, 2 * size, p.cloth_side, p.cloth_side), {0.0, 0.0, 1.0}, 0.4);
  Body sheet = make_cloth("cloth", moved(cloth, {0.01, 0.0, p.cloth_height}), p.cloth);
  sheet.self_contact = true;
  scene.add(std::move(sheet));
  return scene;
}

}  // namespace tact::scenes
