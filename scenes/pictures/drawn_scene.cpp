#include "scenes/pictures/drawn_scene.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/parallel.h"
#include "scenes/pictures/corner_normals.h"
#include "scenes/pictures/symbols.h"

namespace tact::scenes {
namespace {

constexpr double kCrease = 50.0;           // degrees
constexpr double kArrowThickness = 0.016;  // of the shaft, in units of the drawn scene
constexpr double kRingThickness = 0.008;   // likewise, of a disk's rim
// Share of a mark in what is seen, in the open and behind a body.
constexpr float kFacetOpacity = 0.92f;
constexpr float kFacetHiddenOpacity = 0.4f;
constexpr float kSymbolHiddenOpacity = 0.7f;
constexpr float kDiskOpacity = 0.2f;
constexpr float kDiskHiddenOpacity = 0.12f;

// From the scene's coordinates to those of the drawn scene.
class Placement {
 public:
  explicit Placement(const Camera& camera)
      : origin_(camera.position + camera.focus * camera.forward), scale_(1.0 / (camera.focus * camera.tangent_y)) {}

  Eigen::Matrix3Xf operator()(const Eigen::Matrix3Xd& positions) const {
    return (scale_ * (positions.colwise() - origin_)).cast<float>();
  }
  double height(double value, const Eigen::Vector3d& up) const { return scale_ * (value - up.dot(origin_)); }
  double metres(double units) const { return units / scale_; }

 private:
  Eigen::Vector3d origin_;
  double scale_;
};

DrawnMesh drawn_body(const PictureBody& body, const Placement& place, int threads) {
  DrawnMesh mesh{.positions = place(body.positions),
                 .facets = body.facets,
                 .corner_normals = {},
                 .reflectance = linear(body.color),
                 .opacity = static_cast<float>(body.opacity),
                 .edges = true};
  if (body.shading == Shading::smooth)
    mesh.corner_normals = corner_normals(mesh.positions, mesh.facets, kCrease, threads);
  return mesh;
}

DrawnLayer committed(std::vector<DrawnMesh> meshes) {
  DrawnLayer layer{std::move(meshes), {}};
  for (const DrawnMesh& mesh : layer.meshes) layer.rays.add_mesh(mesh.positions, mesh.facets);
  layer.rays.commit();
  return layer;
}

std::vector<DrawnMesh> meeting_facets(const PictureScene& scene, const std::vector<DrawnMesh>& bodies) {
  std::vector<DrawnMesh> marks;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (scene.bodies[i].meeting_facets.empty()) continue;
    DrawnMesh mark{.positions = bodies[i].positions,
                   .facets = bodies[i].facets(Eigen::all, scene.bodies[i].meeting_facets),
                   .corner_normals = {},
                   .reflectance = linear(kMeetingColor),
                   .opacity = kFacetOpacity,
                   .hidden_opacity = scene.facets_shine ? kFacetHiddenOpacity : 0.0f,
                   .edges = true};
    marks.push_back(std::move(mark));
  }
  return marks;
}

DrawnMesh drawn_symbol(const SymbolMesh& symbol, Color color, float opacity, float hidden_opacity,
                       const Placement& place) {
  DrawnMesh mesh{.positions = place(symbol.positions),
                 .facets = symbol.facets,
                 .corner_normals = {},
                 .reflectance = linear(color),
                 .opacity = opacity,
                 .hidden_opacity = hidden_opacity};
  mesh.corner_normals = corner_normals(mesh.positions, mesh.facets, kCrease, 1);
  return mesh;
}

std::vector<DrawnLayer> drawn_marks(const PictureScene& scene, const std::vector<DrawnMesh>& bodies,
                                    const Placement& place) {
  std::vector<DrawnMesh> disks;
  std::vector<DrawnMesh> lines;
  for (const Disk& disk : scene.disks) {
    if (!(disk.radius > 0.0)) continue;
    disks.push_back(drawn_symbol(disk_mesh(disk), disk.color, kDiskOpacity, kDiskHiddenOpacity, place));
    lines.push_back(
        drawn_symbol(ring_mesh(disk, place.metres(kRingThickness)), disk.color, 1.0f, kSymbolHiddenOpacity, place));
  }
  for (const Arrow& arrow : scene.arrows) {
    if (!(arrow.length > 0.0)) continue;
    lines.push_back(
        drawn_symbol(arrow_mesh(arrow, place.metres(kArrowThickness)), arrow.color, 1.0f, kSymbolHiddenOpacity, place));
  }
  std::vector<DrawnLayer> layers;
  std::vector<DrawnMesh> facets = meeting_facets(scene, bodies);
  if (!facets.empty()) layers.push_back(committed(std::move(facets)));
  if (!disks.empty()) layers.push_back(committed(std::move(disks)));
  if (!lines.empty()) layers.push_back(committed(std::move(lines)));
  return layers;
}

// The opaque bodies into `drawn.blockers`, and a ball around them.
void add_blockers(DrawnScene& drawn) {
  Eigen::AlignedBox3f box;
  for (const DrawnMesh& mesh : drawn.bodies.meshes) {
    if (mesh.opacity < 1.0f) continue;
    drawn.blockers.add_mesh(mesh.positions, mesh.facets);
    for (const int vertex : mesh.facets.reshaped()) box.extend(mesh.positions.col(vertex));
  }
  drawn.blockers.commit();
  if (box.isEmpty()) return;
  drawn.middle = box.center();
  drawn.radius = 0.5f * box.diagonal().norm();
}

}  // namespace

Light linear(Color color) {
  const auto channel = [](std::uint8_t value) {
    const float v = static_cast<float>(value) / 255.0f;
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  };
  return {channel(color.red), channel(color.green), channel(color.blue)};
}

Color displayed(const Light& light) {
  const auto channel = [](float value) {
    const float v = std::clamp(value, 0.0f, 1.0f);
    const float s = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(255.0f * s + 0.5f);
  };
  return {channel(light.x()), channel(light.y()), channel(light.z())};
}

DrawnScene drawn_scene(const PictureScene& scene, const Camera& camera, int threads) {
  const Placement place(camera);
  const Eigen::Vector3d up = up_vector(scene.up);
  DrawnScene drawn;
  drawn.eye = place(camera.position).col(0);
  drawn.forward = camera.forward.cast<float>();
  drawn.right = (camera.tangent_x * camera.right).cast<float>();
  drawn.down = (camera.tangent_y * camera.down).cast<float>();
  drawn.up = up.cast<float>();
  if (scene.ground) drawn.ground = static_cast<float>(place.height(*scene.ground, up));

  std::vector<DrawnMesh> bodies(scene.bodies.size());
  base::parallel_for(bodies.size(), 1, threads,
                     [&](std::size_t i) { bodies[i] = drawn_body(scene.bodies[i], place, 1); });
  drawn.marks = drawn_marks(scene, bodies, place);
  drawn.bodies = committed(std::move(bodies));
  add_blockers(drawn);
  return drawn;
}

}  // namespace tact::scenes
