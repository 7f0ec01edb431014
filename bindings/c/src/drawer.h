// The functions of a C program that draw, as a drawer of C++.
#pragma once

#include <tact/debug_draw.h>

#include <string>

#include "handles.h"

namespace tact::c {

inline tact_debug_color color_of(const DebugColor& c) { return {c.red, c.green, c.blue, c.alpha}; }
inline DebugColor color_of(const tact_debug_color& c) { return {c.red, c.green, c.blue, c.alpha}; }

// The functions of C as a drawer.
class CDrawer : public DebugDrawer {
 public:
  // Throws for what lacks a function.
  explicit CDrawer(const tact_debug_drawer* drawer) {
    check_not_null(drawer);
    if (drawer->line == nullptr || drawer->triangle == nullptr || drawer->text == nullptr)
      throw Failure{TACT_ERROR_NULL_ARGUMENT, "a function of the drawer is null"};
    drawer_ = *drawer;
  }
  void line(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const DebugColor& color) override {
    drawer_.line(drawer_.user, from.data(), to.data(), color_of(color));
  }
  void triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Eigen::Vector3d& r,
                const DebugColor& color) override {
    drawer_.triangle(drawer_.user, p.data(), q.data(), r.data(), color_of(color));
  }
  void text(const Eigen::Vector3d& at, std::string_view words, const DebugColor& color) override {
    drawer_.text(drawer_.user, at.data(), std::string(words).c_str(), color_of(color));
  }

 private:
  tact_debug_drawer drawer_{};
};

}  // namespace tact::c
