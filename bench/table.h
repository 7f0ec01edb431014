// A table of results: printed in columns, kept as a CSV file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tact::bench {

class Table {
 public:
  explicit Table(std::vector<std::string> header) : header_(std::move(header)) {}

  // One cell a column.
  void add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }
  bool empty() const { return rows_.empty(); }

  // Columns as wide as they need to be, the first to the left, the others to the right; a blank line follows.
  void print() const;
  // Cells with commas or quotes are quoted. Errors: std::runtime_error, naming the file.
  void write_csv(const std::filesystem::path& file) const;

 private:
  std::vector<std::string> header_;
  std::vector<std::vector<std::string>> rows_;
};

// A time or a factor with three significant digits.
std::string three_digits(double value);

// A line that says where the figures come from: processor, number of them, threads, compiler.
std::string machine_line(int threads);

// Which commit was built, with "-dirty" behind it if files differed from it.
extern const char* const kCommit;

// The number of threads that 0 stands for, or `asked`.
int thread_count(int asked);

// "1 thread", "2 threads"
std::vector<std::string> thread_names(const std::vector<int>& counts);

// Runs gnuplot on `script`, once with output to out/name.png and once to out/name.svg, in the folder `out`.
// Errors: std::runtime_error if gnuplot is missing or fails.
void plot(const std::filesystem::path& out, const std::string& name, const std::string& script);

// Groups of bars beside each other.
struct BarChart {
  struct Group {
    std::string label;
    std::vector<double> values;  // one for each of `bars`; then that of `mark`, if it has a name
  };
  std::string title;
  std::string unit;  // of the values
  std::vector<std::string> bars;
  std::string mark = {};      // a dot over each group
  std::string settings = {};  // of gnuplot
  std::vector<Group> groups = {};
};
void plot_bars(const std::filesystem::path& out, const std::string& name, const BarChart& chart);

}  // namespace tact::bench
