// What keeps a soft closed body in shape: its volume, and a pull of all vertices towards the shape at rest.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "scenes/dynamics/mesh.h"
#include "scenes/dynamics/rotation.h"

namespace tact::scenes {

// The volume that closed facets enclose, cubic metres, with their signs: negative if they are inside out.
double enclosed_volume(const std::vector<Vec3>& positions, const Eigen::Matrix3Xi& facets);

// Keeps the enclosed volume near that at rest. XPBD with the volume as the only constraint function.
class VolumeKeeper {
 public:
  // `bulk_modulus` in pascals, positive: the pressure that would change the volume by its own size.
  VolumeKeeper(const Mesh& rest, double bulk_modulus);

  // One iteration for a substep of `h` seconds.
  void solve(std::vector<Vec3>& positions, const Eigen::Matrix3Xi& facets, const std::vector<double>& inverse_masses,
             double h);

 private:
  double rest_volume_;
  double compliance_;
  std::vector<Vec3> gradient_;  // kept between calls to spare allocations
};

// Pulls each vertex towards its place in the shape at rest, moved, turned and partly sheared as the body is now. All
// masses that are not infinite must be equal: then momentum and angular momentum stay. Source: M. Müller et al.,
// Meshless Deformations Based on Shape Matching, SIGGRAPH 2005.
class ShapeKeeper {
 public:
  // `frequency` in hertz, positive: how fast a vertex alone would swing about its place. `stretch`, 0 to 1: how much of
  // the body's linear deformation is let be; 0 pulls towards the rigid shape.
  ShapeKeeper(const std::vector<Vec3>& rest, double frequency, double stretch);

  // One iteration for a substep of `h` seconds. Vertices whose inverse mass is 0 stay.
  void solve(std::vector<Vec3>& positions, const std::vector<double>& inverse_masses, double h);

  // How the body was turned in the last call, from which the next one starts: all that it remembers.
  const Quaternion& rotation() const { return rotation_; }
  void set_rotation(const Quaternion& rotation) { rotation_ = rotation; }

 private:
  std::vector<Vec3> rest_;  // from the centre
  Matrix inverse_spread_;   // (sum of r rᵀ)⁻¹
  double stiffness_;        // newtons a metre and kilogram
  double stretch_;
  Quaternion rotation_;
};

}  // namespace tact::scenes
