// A body of the page: its positions as whole numbers of a small step.
#pragma once

#include <tact/body.h>

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scenes/view/view_bytes.h"

namespace tact::scenes {

// What a body has besides facets.
struct ThinParts {
  Eigen::Matrix2Xi edges{2, 0};  // vertices of ropes
  std::vector<int> points = {};  // vertices that stand alone
  std::optional<Plane> plane = {};
};

// A body as a command gives it to the page.
struct BodyForView {
  std::string name = {};
  Surface surface = Surface::closed;
  Motion motion = Motion::deformable;
  double opacity = 1.0;                          // at first; 0: hidden
  Eigen::Ref<const Eigen::Matrix3Xd> positions;  // 3 x V, metres
  const Eigen::Matrix3Xi& facets;
  ThinParts thin = {};
};

// For the view alone positions are rounded: to a power of two of metres, at most 1/64 of a mean edge and 1/1024 of the
// body's size, where it was when it was added. What is farther than 2^28 of these from there is shown there.
class ViewedBody {
 public:
  ViewedBody(BodyId id, const BodyForView& body, int first_frame);

  void set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions);

  // Appends the positions as they are to a chunk; the first of a chunk can be read without those before.
  void write(ViewBytes& out);
  void begin_chunk() { written_ = 0; }

  BodyId id;
  std::string name;
  Surface surface;
  Motion motion;
  double opacity;
  Eigen::Matrix3Xi facets;
  ThinParts thin;
  std::vector<int> clusters = {};  // as last written
  int first_frame;                 // of the page
  int end_frame = std::numeric_limits<int>::max();
  bool cut_off = false;  // was any position too far away?

  double step() const { return step_; }
  const std::array<double, 3>& origin() const { return origin_; }
  std::size_t vertex_count() const { return now_.size() / 3; }

 private:
  double step_;                   // metres
  std::array<double, 3> origin_;  // metres
  std::vector<std::int32_t> now_, last_, before_last_;
  int written_ = 0;  // frames of this chunk
  bool moved_ = true;
};

}  // namespace tact::scenes
