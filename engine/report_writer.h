// Stage 7: the one place where a report is written, from the records of the pairs.
#pragma once

#include <tact/report.h>
#include <tact/settings.h>

#include <cstdint>
#include <vector>

#include "engine/pair/pair_table.h"
#include "engine/self_stage.h"

namespace tact {

/// What the answers of a report came from: the world's.
struct ReportSources {
  const Bodies* bodies;
  PairTable* table;
  const Settings* settings;
  const std::vector<std::uint64_t>* keys;  // of the report
};

/// Holds the report of a world. What a step did not look at stays as it is: those records, far apart in memory, are not
/// read.
class ReportWriter {
 public:
  const Report& report() const { return report_; }
  StepStats& stats() { return report_.stats_; }
  std::vector<TraceEvent>& trace() { return report_.trace_; }
  std::vector<PatchEvent>& patch_events() { return report_.patch_events_; }

  /// Candidate pairs, contacts and events as the records have them now, and the counts of contacts.
  void write(PairTable& table, const SelfStage& self, const Bodies& bodies, const Settings& settings);
  /// Takes over the contacts that the records have, as if the last report had them.
  void restore(PairTable& table, const SelfStage& self, const Bodies& bodies);
  /// The next report is the first.
  void forget();
  /// Where the answers of this step come from: they must outlive the report.
  void note_sources(const Bodies& bodies, PairTable& table, const Settings& settings) {
    sources_ = {&bodies, &table, &settings, &report_.keys_};
    report_.sources_ = &sources_;
  }

 private:
  /// A contact of the report: a candidate, or a body with itself.
  struct Reported {
    std::uint32_t place = 0;  // among the candidates
    const SelfRecord* self = nullptr;
  };
  /// Of contacts, added up.
  struct alignas(64) Totals {
    std::int64_t facet_pairs = 0, points = 0, within_reach = 0;
    std::int64_t touching = 0, point_limits = 0;
    void add(const Contact& contact, std::int64_t times);
    void add(const Totals& other);
  };

  static void fill(Contact& contact, const PairRecord& record, const BodyKeys& keys);
  static void fill(Contact& contact, const SelfRecord& record, const BodyKeys& keys);
  template <class Record>
  static void replace(Contact& contact, const Record& by, const BodyKeys& keys, Totals& totals);
  void copy_keys(const BodyKeys& keys);
  void list_contacts(const PairTable& table, const SelfStage& self, const BodyKeys& keys);
  void carry_contacts(PairTable& table, int threads);
  void write_candidates(const PairTable& table, bool same);
  void write_contacts(PairTable& table, const Bodies& bodies, const Settings& settings);
  void write_events(const PairTable& table, const SelfStage& self, const Bodies& bodies);
  void add_thread_totals();

  Report report_;
  ReportSources sources_ = {};
  std::uint64_t keys_version_ = 0;      // of the report's
  std::vector<Reported> reported_;      // the contacts of the report, in its order
  bool has_self_ = false;               // whether any is of a body with itself
  std::vector<Contact> last_contacts_;  // of the last report, while a new one is made
  Totals totals_;                       // of the contacts of the report
  std::vector<Totals> thread_totals_;   // scratch
};

}  // namespace tact
