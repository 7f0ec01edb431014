#include "bench/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "engine/base/parallel.h"

namespace tact::bench {
namespace {

// Width on the screen: bytes that continue a character of UTF-8 take none.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

std::string quoted(const std::string& cell) {
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string text = "\"";
  for (const char c : cell) text += c == '"' ? std::string("\"\"") : std::string(1, c);
  return text + '"';
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown processor";
}

}  // namespace

void Table::print() const {
  std::vector<std::vector<std::string>> lines{header_};
  lines.insert(lines.end(), rows_.begin(), rows_.end());
  for (const auto& line : lines) {
    std::string text;
    for (std::size_t k = 0; k < line.size(); ++k) {
      std::size_t width = 0;
      for (const auto& other : lines) width = std::max(width, width_of(other[k]));
      const std::string space(width - width_of(line[k]), ' ');
      text += (k == 0 ? line[k] + space : "  " + space + line[k]);
    }
    fmt::print("{}\n", text);
  }
  fmt::print("\n");
  std::fflush(stdout);
}

void Table::write_csv(const std::filesystem::path& file) const {
  std::ofstream out(file);
  const auto write = [&](const std::vector<std::string>& line) {
    for (std::size_t k = 0; k < line.size(); ++k) out << (k == 0 ? "" : ",") << quoted(line[k]);
    out << '\n';
  };
  write(header_);
  for (const auto& row : rows_) write(row);
  if (!out.flush()) throw std::runtime_error("cannot write " + file.string());
}

std::string three_digits(double value) {
  return value >= 99.95 ? fmt::format("{:.0f}", value) : fmt::format("{:#.3g}", value);
}

std::string machine_line(int threads) {
  return fmt::format("{}, {} processors, {}, compiler {}", processor_name(), std::thread::hardware_concurrency(),
                     thread_names({threads}).front(), __VERSION__);
}

std::vector<std::string> thread_names(const std::vector<int>& counts) {
  std::vector<std::string> names;
  for (const int count : counts) names.push_back(fmt::format("{} thread{}", count, count == 1 ? "" : "s"));
  return names;
}

int thread_count(int asked) { return asked > 0 ? asked : base::default_threads(); }

void plot_bars(const std::filesystem::path& out, const std::string& name, const BarChart& chart) {
  std::string script = "$bars << EOD\n";
  for (const BarChart::Group& group : chart.groups) {
    script += fmt::format("\"{}\" {:.4g}\n", group.label, fmt::join(group.values, " "));
  }
  script += fmt::format(
      "EOD\nset title '{}'\nset ylabel '{}'\nset style data histograms\nset style fill solid 0.8\nset grid y\n"
      "set xtics rotate by -35\nset rmargin 14\nset key above\nset yrange [0:*]\n{}\nplot ",
      chart.title, chart.unit, chart.settings);
  for (std::size_t k = 0; k < chart.bars.size(); ++k)
    script += fmt::format("{}$bars using {}:xtic(1) title '{}'", k == 0 ? "" : ", ", k + 2, chart.bars[k]);
  if (!chart.mark.empty())
    script +=
        fmt::format(", $bars using {} with points pt 7 lc rgb 'black' title '{}'", chart.bars.size() + 2, chart.mark);
  plot(out, name, script);
}

void plot(const std::filesystem::path& out, const std::string& name, const std::string& script) {
  for (const auto& [terminal, ending] : {std::pair{"pngcairo size 1200,700", "png"}, {"svg size 1200,700", "svg"}}) {
    const std::string command = "cd '" + out.string() + "' && gnuplot";
    std::FILE* pipe = popen(command.c_str(), "w");
    if (pipe == nullptr) throw std::runtime_error("cannot run gnuplot");
    fmt::print(pipe, "set terminal {} font 'sans,13'\nset output '{}.{}'\n{}\n", terminal, name, ending, script);
    if (pclose(pipe) != 0) {
      throw std::runtime_error(fmt::format("gnuplot could not make {}.{}: is it installed?", name, ending));
    }
  }
}

}  // namespace tact::bench
