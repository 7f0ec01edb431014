// What the benchmark `error` prints and writes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/error/measure.h"

namespace tact::bench {

enum class Query { hulls, facet_pairs };

// The results of one row.
struct ErrorTable {
  std::string row;
  Query query = Query::hulls;
  std::vector<ErrorResult> results;
};

void print(const ErrorTable& table);
// Says which rivals are at least as accurate as tact at its default setting, and faster; for hulls that is held against
// both policies. Errors below what tact promises, 1e-12 of size and 1e-9 radians, are taken as equal.
void print_verdict(const ErrorTable& table);
void write_csv(const std::vector<ErrorTable>& tables, const std::filesystem::path& file);
// A panel a row: time across, the largest error of depth or the share of missed and wrong facet pairs upwards.
void plot_tables(const std::vector<ErrorTable>& tables, Query query, const std::filesystem::path& out,
                 const std::string& name);

// What is wrong with an answer of tact: empty if nothing is.
std::string fault_of(const ErrorResult& result, Query query);

}  // namespace tact::bench
