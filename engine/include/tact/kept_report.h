// A report that stays: what a step found, copied out of the world.
#pragma once

#include <tact/report.h>

#include <memory>

namespace tact {

/// What a step found, with memory of its own: it stays as it is while the world goes on, changes or is destroyed. Many
/// threads may read it at once. Two of them in turns let other threads read one step while the next one runs. One that
/// was moved to another can only be assigned to and destroyed.
class TACT_API KeptReport {
 public:
  /// An empty one. Errors: out_of_memory.
  KeptReport();
  ~KeptReport();
  KeptReport(KeptReport&&) noexcept;
  KeptReport& operator=(KeptReport&&) noexcept;

  /// Copies a report; memory is reused. Errors: out_of_memory, after which it is empty.
  void keep(const Report& report);
  /// Returns the report, valid until the next keep(). It has no outcomes of facets, which debug_draw() shows of reports
  /// of worlds.
  const Report& report() const noexcept;

 private:
  struct Lists;
  std::unique_ptr<Lists> lists_;
};

}  // namespace tact
