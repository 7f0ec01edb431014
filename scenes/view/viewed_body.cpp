#include "scenes/view/viewed_body.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace tact::scenes {
namespace {

constexpr double kStepsAnEdge = 64.0, kStepsABody = 1024.0;
constexpr double kLargest = 1 << 28;  // steps: what is left of a guess then fits 32 bits

// How the positions of a body stand in a chunk: see viewer/src/chunk.js.
enum class Coding : std::uint8_t { same, absolute, since_last, since_straight };

double mean_edge(const BodyForView& body) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < body.facets.cols(); ++i) {
    sum += (body.positions.col(body.facets(1, i)) - body.positions.col(body.facets(0, i))).norm();
  }
  const Eigen::Matrix2Xi& edges = body.thin.edges;
  for (const auto& edge : edges.colwise()) sum += (body.positions.col(edge[1]) - body.positions.col(edge[0])).norm();
  const Eigen::Index count = body.facets.cols() + edges.cols();
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

double step_for(const BodyForView& body) {
  if (body.positions.cols() == 0) return 1.0;
  const double size = (body.positions.rowwise().maxCoeff() - body.positions.rowwise().minCoeff()).maxCoeff();
  const double edge = mean_edge(body), largest = std::max(size, body.positions.cwiseAbs().maxCoeff() * 1e-12);
  double step = largest / kStepsABody;
  if (edge > 0.0) step = std::min(step, std::max(edge / kStepsAnEdge, largest / kLargest));
  return step > 0.0 && std::isfinite(step) ? std::ldexp(1.0, std::ilogb(step)) : 1.0;
}

// What is left of each coordinate when a guess at it is taken away, and the sum of their sizes.
template <class Guess>
std::int64_t write_rest(const std::vector<std::int32_t>& now, const Guess& guess, ViewBytes* out) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const std::int64_t rest = std::int64_t{now[i]} - guess(i);
    sum += std::abs(rest);
    if (out != nullptr) out->add_signed(rest);
  }
  return sum;
}

}  // namespace

ViewedBody::ViewedBody(BodyId body_id, const BodyForView& body, int first)
    : id(body_id),
      name(body.name),
      surface(body.surface),
      motion(body.motion),
      opacity(body.opacity),
      facets(body.facets),
      thin(body.thin),
      first_frame(first),
      step_(step_for(body)),
      origin_{},
      now_(static_cast<std::size_t>(body.positions.size())) {
  if (body.positions.cols() > 0) {
    const Eigen::Vector3d middle =
        0.5 * body.positions.rowwise().maxCoeff() + 0.5 * body.positions.rowwise().minCoeff();
    for (std::size_t k = 0; k < 3; ++k) origin_[k] = middle[k];
  }
  set_positions(body.positions);
}

void ViewedBody::set_positions(const Eigen::Ref<const Eigen::Matrix3Xd>& positions) {
  for (std::size_t i = 0; i < now_.size(); ++i) {
    const double steps = (positions.data()[i] - origin_[i % 3]) / step_;
    cut_off = cut_off || !(std::abs(steps) <= kLargest);
    const auto whole = static_cast<std::int32_t>(std::lrint(std::clamp(steps, -kLargest, kLargest)));
    moved_ = moved_ || whole != now_[i];
    now_[i] = whole;
  }
}

void ViewedBody::write(ViewBytes& out) {
  const auto last = [&](std::size_t i) { return std::int64_t{last_[i]}; };
  const auto straight = [&](std::size_t i) { return 2 * std::int64_t{last_[i]} - before_last_[i]; };
  const auto neighbour = [&](std::size_t i) { return i < 3 ? std::int64_t{0} : std::int64_t{now_[i - 3]}; };
  if (written_ == 0) {
    out.add_byte(static_cast<std::uint8_t>(Coding::absolute));
    write_rest(now_, neighbour, &out);
  } else if (!moved_) {
    out.add_byte(static_cast<std::uint8_t>(Coding::same));
  } else if (written_ == 1 || write_rest(now_, last, nullptr) <= write_rest(now_, straight, nullptr)) {
    out.add_byte(static_cast<std::uint8_t>(Coding::since_last));
    write_rest(now_, last, &out);
  } else {
    out.add_byte(static_cast<std::uint8_t>(Coding::since_straight));
    write_rest(now_, straight, &out);
  }
  std::swap(before_last_, last_);
  last_ = now_;
  ++written_;
  moved_ = false;
}

}  // namespace tact::scenes
