#include <ccd/ccd.h>
#include <ccd/quat.h>
#include <fmt/format.h>

#include <cmath>

#include "bench/error/methods.h"

namespace tact::bench {
namespace {

struct Points {
  const Eigen::Matrix3Xd* positions = nullptr;
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
};

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* farthest) {
  const Points& points = *static_cast<const Points*>(object);
  const Eigen::Vector3d n(direction->v[0], direction->v[1], direction->v[2]);
  double height = n.dot(points.positions->col(0));
  Eigen::Index best = 0;
  for (Eigen::Index v = 1; v < points.positions->cols(); ++v) {
    const double h = n.dot(points.positions->col(v));
    if (h > height) {
      height = h;
      best = v;
    }
  }
  const Eigen::Vector3d p = points.positions->col(best) + points.shift;
  ccdVec3Set(farthest, p.x(), p.y(), p.z());
}

void center(const void* object, ccd_vec3_t* middle) {
  const Points& points = *static_cast<const Points*>(object);
  const Eigen::Vector3d p = points.center + points.shift;
  ccdVec3Set(middle, p.x(), p.y(), p.z());
}

enum class Algorithm { epa, mpr };

class LibccdHulls : public HullMethod {
 public:
  LibccdHulls(const HullRow& row, Algorithm algorithm, double tolerance)
      : row_(row), algorithm_(algorithm), answers_(row.pairs.size()) {
    for (const HullPair& pair : row.pairs) {
      a_.push_back({&pair.a.positions, Eigen::Vector3d::Zero(), pair.a.positions.rowwise().mean()});
      b_.push_back({&pair.b.positions, Eigen::Vector3d::Zero(), pair.b.positions.rowwise().mean()});
    }
    CCD_INIT(&settings_);
    settings_.support1 = settings_.support2 = support;
    settings_.center1 = settings_.center2 = center;
    settings_.max_iterations = 1000;
    settings_.epa_tolerance = settings_.mpr_tolerance = tolerance;
  }

  void step(int frame) override {
    const auto penetration = algorithm_ == Algorithm::epa ? ccdGJKPenetration : ccdMPRPenetration;
    for (std::size_t i = 0; i < a_.size(); ++i) {
      b_[i].shift = row_.pairs[i].path[frame];
      ccd_vec3_t direction, position;
      HullAnswer& answer = answers_[i];
      const int status = penetration(&a_[i], &b_[i], &settings_, &answer.depth, &direction, &position);
      answer.overlap = status == 0;
      answer.failed = status < -1;
      answer.direction = {direction.v[0], direction.v[1], direction.v[2]};
    }
  }

  HullAnswer answer(std::size_t pair) const override {
    HullAnswer answer = answers_[pair];
    if (answer.overlap && !(std::isfinite(answer.depth) && answer.direction.allFinite())) answer.failed = true;
    return answer;
  }

 private:
  const HullRow& row_;
  Algorithm algorithm_;
  ccd_t settings_;
  std::vector<Points> a_, b_;
  std::vector<HullAnswer> answers_;
};

}  // namespace

std::vector<HullMethodKind> libccd_hull_methods() {
  std::vector<HullMethodKind> kinds;
  for (const Algorithm algorithm : {Algorithm::epa, Algorithm::mpr}) {
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
      kinds.push_back({"libccd", fmt::format("{}, {:.0e}", algorithm == Algorithm::epa ? "GJK+EPA" : "MPR", tolerance),
                       Minimum::smallest,
                       [=](const HullRow& row) { return std::make_unique<LibccdHulls>(row, algorithm, tolerance); }});
    }
  }
  return kinds;
}

}  // namespace tact::bench
