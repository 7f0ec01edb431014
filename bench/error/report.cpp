#include "bench/error/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "bench/table.h"

namespace tact::bench {
namespace {

// What tact promises; errors below are taken as equal. A direction is that of a face: its error is rounding over the
// face's width.
constexpr double kDepthPromise = 1e-12;     // of size
constexpr double kDirectionPromise = 1e-9;  // radians

// Where no error is drawn: below all others.
constexpr double kLeastDepthDrawn = 1e-17;
constexpr double kLeastShareDrawn = 1e-7;

std::string scientific(const std::optional<double>& value) { return value ? fmt::format("{:.1e}", *value) : "-"; }

int mistakes(const ErrorResult& r) { return r.missed + r.wrong + r.failed; }

bool as_accurate(const ErrorResult& rival, const ErrorResult& tact, Query query) {
  if (mistakes(rival) > mistakes(tact)) return false;
  if (query == Query::facet_pairs) return true;
  if (!rival.depth_error || !tact.depth_error) return false;
  return *rival.depth_error <= std::max(*tact.depth_error, kDepthPromise) &&
         *rival.direction_error <= std::max(*tact.direction_error, kDirectionPromise);
}

double drawn_error(const ErrorResult& r, Query query) {
  if (query == Query::facet_pairs) {
    return std::max(kLeastShareDrawn, static_cast<double>(r.missed + r.wrong) / std::max(1, r.queries));
  }
  return std::max(kLeastDepthDrawn, r.depth_error.value_or(1.0));
}

// Not a level without facet pairs, where these are what is asked for.
bool is_drawn(const ErrorResult& r, Query query) { return query == Query::hulls || r.queries > 0; }

// "tact, exact" and "tact, smallest" are series of their own: settings that differ in tolerance share one.
std::string series_of(const ErrorResult& r) {
  const std::size_t last = r.setting.rfind(", ");
  const bool has_tolerance = r.setting.find("e-") != std::string::npos;
  const std::string setting = has_tolerance && last != std::string::npos ? r.setting.substr(0, last) : r.setting;
  return r.library + (setting.empty() ? "" : ", " + setting);
}

}  // namespace

void print(const ErrorTable& table) {
  const bool pairs = table.query == Query::facet_pairs;
  fmt::print("{}\n", table.row);
  Table columns({"library, setting", "µs", "asked", "missed", "wrong", "failed", "depth error", "median",
                 "direction error", "median"});
  for (const ErrorResult& r : table.results) {
    columns.add({r.library + ", " + r.setting, three_digits(r.microseconds),
                 pairs && r.queries == 0 ? "-" : fmt::format("{}", r.queries), fmt::format("{}", r.missed),
                 fmt::format("{}", r.wrong), fmt::format("{}", r.failed), scientific(r.depth_error),
                 scientific(r.median_depth_error), scientific(r.direction_error),
                 scientific(r.median_direction_error)});
  }
  columns.print();
}

void print_verdict(const ErrorTable& table) {
  bool any = false;
  for (const ErrorResult& tact : table.results) {
    if (tact.library != "tact" || !is_drawn(tact, table.query)) continue;
    for (const ErrorResult& r : table.results) {
      if (r.library == "tact" || r.microseconds >= tact.microseconds || !as_accurate(r, tact, table.query)) continue;
      fmt::print("  {} {} is as accurate as tact ({}) and {} times as fast.\n", r.library, r.setting, tact.setting,
                 three_digits(tact.microseconds / r.microseconds));
      any = true;
    }
  }
  if (!any) fmt::print("  No rival is as accurate as any setting of tact and faster.\n");
  fmt::print("\n");
}

void write_csv(const std::vector<ErrorTable>& tables, const std::filesystem::path& file) {
  Table csv({"row", "library", "setting", "minimum", "microseconds", "asked", "missed", "wrong", "failed",
             "depth_error", "median_depth_error", "direction_error", "median_direction_error"});
  for (const ErrorTable& table : tables) {
    for (const ErrorResult& r : table.results) {
      csv.add({r.row, r.library, r.setting, r.minimum == Minimum::local ? "local" : "smallest",
               three_digits(r.microseconds), fmt::format("{}", r.queries), fmt::format("{}", r.missed),
               fmt::format("{}", r.wrong), fmt::format("{}", r.failed), scientific(r.depth_error),
               scientific(r.median_depth_error), scientific(r.direction_error), scientific(r.median_direction_error)});
    }
  }
  csv.write_csv(file);
}

void plot_tables(const std::vector<ErrorTable>& tables, Query query, const std::filesystem::path& out,
                 const std::string& name) {
  std::vector<const ErrorTable*> panels;
  std::map<std::string, int> number;  // of each series, the same in all panels
  for (const ErrorTable& table : tables) {
    if (table.query != query) continue;
    panels.push_back(&table);
    for (const ErrorResult& r : table.results) {
      if (is_drawn(r, query)) number.try_emplace(series_of(r), static_cast<int>(number.size()) + 1);
    }
  }
  const std::size_t columns = std::min<std::size_t>(panels.size() + 1, query == Query::hulls ? 4 : 2);
  const std::size_t lines = (panels.size() + columns) / columns;
  std::string script = fmt::format(
      "set multiplot layout {},{}\nset logscale xy\nset format x '%g'\nset format y '10^{{%L}}'\nset key off\n"
      "set xlabel 'µs a pair and step'\nset grid\n",
      lines, columns);
  script += query == Query::hulls ? "set yrange [3e-18:1]\nset ylabel 'largest error of depth / size'\n"
                                  : fmt::format("set yrange [{}:1]\nset ylabel 'missed or wrong (10^{{-7}}: none)'\n",
                                                0.3 * kLeastShareDrawn);
  const auto style = [&](const std::string& series) {
    const int n = number.at(series);
    const bool tact = series.starts_with("tact");
    return fmt::format("with points pt {} ps {} lc {}", tact ? 7 : n % 13 + 1, tact ? 1.3 : 1.0, n);
  };
  for (const ErrorTable* panel : panels) {
    script += fmt::format("set title '{}'\n", panel->row);
    std::map<std::string, std::string> points;
    for (const ErrorResult& r : panel->results) {
      if (!is_drawn(r, query)) continue;
      points[series_of(r)] += fmt::format("{} {}\n", r.microseconds, drawn_error(r, query));
    }
    std::string plots, data;
    for (const auto& [series, lines_of] : points) {
      plots += (plots.empty() ? "plot " : ", ") + fmt::format("'-' {} title '{}'", style(series), series);
      data += lines_of + "e\n";
    }
    script += plots + "\n" + data;
  }
  // The key has a panel of its own.
  script +=
      "set title ''\nunset xlabel\nunset ylabel\nunset tics\nunset border\nunset grid\nset key center center\nset "
      "xrange [1:2]\n";
  std::string key;
  for (const auto& [series, n] : number)
    key += (key.empty() ? "plot " : ", ") + fmt::format("1e-30 {} title '{}'", style(series), series);
  plot(out, name, script + key + "\nunset multiplot");
}

std::string fault_of(const ErrorResult& r, Query query) {
  const bool promises_pairs = query == Query::facet_pairs && r.setting.starts_with("exact");
  if (r.wrong > 0) return fmt::format("{} wrong", r.wrong);
  if (r.failed > 0) return fmt::format("{} failed", r.failed);
  if (r.missed > 0 && (promises_pairs || query == Query::hulls)) return fmt::format("{} missed", r.missed);
  if (r.depth_error.value_or(0.0) > kDepthPromise) return "depth off by " + scientific(r.depth_error);
  if (r.direction_error.value_or(0.0) > kDirectionPromise) return "direction off by " + scientific(r.direction_error);
  return {};
}

}  // namespace tact::bench
