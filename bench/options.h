// What every benchmark is told on the command line.
#pragma once

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace tact::bench {

struct BenchOptions {
  bool quick = false;                  // a short run that exercises everything and measures little: under 20 s
  int threads = 0;                     // the most threads to measure with; 0: as many as OpenMP would use
  std::filesystem::path out = {};      // folder for tables and plots, which exists; empty: none are written
  std::vector<std::string> only = {};  // texts; none: all is played. See Command::has_workloads

  // Whether a name holds one of the texts.
  bool plays(std::string_view name) const {
    return only.empty() || std::ranges::any_of(only, [&](const std::string& text) {
             return name.find(text) != std::string_view::npos;
           });
  }
  // Nothing was played: throws.
  [[noreturn]] void reject_only() const {
    std::string texts;
    for (const std::string& text : only) texts += (texts.empty() ? "'" : ", '") + text + "'";
    throw std::runtime_error("no workload's name holds " + texts);
  }
};

}  // namespace tact::bench
