// Triangles for rays to hit: Embree behind plain functions. Rays only read, so any number of threads may trace at once.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace tact::scenes {

struct Ray {
  Eigen::Vector3f origin;
  Eigen::Vector3f direction;  // unit
  float nearest = 0.0f;       // hits before it do not count
};

struct RayHit {
  float distance = 0.0f;
  std::uint32_t mesh = 0;  // the number of the mesh, in the order in which meshes were added
  std::uint32_t facet = 0;
  std::array<float, 3> weights{};                    // barycentric weights of the facet's corners
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // unit, of the facet as its corners turn
};

// Eight rays from one point.
inline constexpr int kBundle = 8;
struct RayBundle {
  Eigen::Vector3f origin;
  std::array<Eigen::Vector3f, kBundle> directions;  // unit
  float farthest = 0.0f;                            // hits beyond it do not count
};

class RayScene {
 public:
  RayScene();
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // 3 x V positions and 3 x F facets are copied. A mesh without facets takes its number and is never hit.
  void add_mesh(const Eigen::Matrix3Xf& positions, const Eigen::Matrix3Xi& facets);
  // Builds the tree, in this thread alone, so that it is the same for any number of threads. Rays come after it.
  // Errors: tact::Error, out_of_memory or backend_failure.
  void commit();

  std::optional<RayHit> closest(const Ray& ray) const;
  // Which rays of the bundle hit anything: bit i for direction i.
  unsigned hits(const RayBundle& bundle) const;
  bool empty() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tact::scenes
