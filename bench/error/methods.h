// Ways to find the direction and the depth of two overlapping hulls: tact, and the libraries that it is held against.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bench/error/hulls.h"

namespace tact::bench {

struct HullAnswer {
  bool overlap = false;
  double depth = 0.0;                                   // metres, if they overlap
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // from a to b, if they overlap
  bool failed = false;                                  // threw, or gave something that is not a number
};

// All pairs of one row.
class HullMethod {
 public:
  virtual ~HullMethod() = default;
  HullMethod() = default;
  HullMethod(const HullMethod&) = delete;
  HullMethod& operator=(const HullMethod&) = delete;

  // All that is timed: from the shifts of `frame` to the answers for all pairs. Bodies are shifted in the way that is
  // cheapest for the library: by a transform where it has one.
  virtual void step(int frame) = 0;
  virtual HullAnswer answer(std::size_t pair) const = 0;
};

enum class Minimum {
  smallest,  // the smallest separation of the hulls
  local,     // the local minimum that the direction of the last step leads to
};

struct HullMethodKind {
  std::string library;  // "tact" or a rival's name
  std::string setting;
  Minimum minimum = Minimum::smallest;
  // The row outlives the method. One thread.
  std::function<std::unique_ptr<HullMethod>(const HullRow& row)> make;
};

std::vector<HullMethodKind> tact_hull_methods();
std::vector<HullMethodKind> fcl_hull_methods();
std::vector<HullMethodKind> libccd_hull_methods();
std::vector<HullMethodKind> bullet_hull_methods();

}  // namespace tact::bench
