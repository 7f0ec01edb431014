// A ball of two pyramids, which the migration examples move: both libraries get the same numbers.
#pragma once

#include <Eigen/Core>

namespace example {

struct Ball {
  Eigen::Matrix3Xd positions;  // 3 x 6, metres
  Eigen::Matrix3Xi facets;     // 3 x 8, counter-clockwise seen from outside
};

inline Ball ball(double x) {
  Ball ball{Eigen::Matrix3Xd(3, 6), Eigen::Matrix3Xi(3, 8)};
  ball.positions << x + 1, x - 1, x, x, x, x,  //
      0, 0, 1, -1, 0, 0,                       //
      0, 0, 0, 0, 1, -1;
  ball.facets << 0, 2, 1, 3, 2, 1, 3, 0,  //
      2, 1, 3, 0, 0, 2, 1, 3,             //
      4, 4, 4, 4, 5, 5, 5, 5;
  return ball;
}

}  // namespace example
