#include <fmt/format.h>
#include <fmt/os.h>
#include <tact/version.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <vector>

#include "bench/commands.h"
#include "bench/table.h"

namespace {

constexpr int kFailed = 1;
constexpr int kWrongUsage = 2;

int fail(int status, const char* message) {
  fmt::print(stderr, "tact-bench: {}\n", message);
  return status;
}

int run(const tact::bench::Command& command, const tact::bench::BenchOptions& options) {
  if (!options.out.empty()) {
    std::filesystem::create_directories(options.out);
    fmt::output_file((options.out / "machine.txt").string())
        .print("tact {}, commit {}, {}{}\n{}\n", TACT_VERSION, tact::bench::kCommit, command.name,
               options.quick ? ", quick" : "", tact::bench::machine_line(tact::bench::thread_count(options.threads)));
  }
  return command.run(options);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program("Measures tact. Without a name the benchmarks are listed.", "tact-bench");
  program.set_version_flag("--version", "tact-bench " TACT_VERSION, "Print the version and exit");
  program.require_subcommand(0, 1);
  tact::bench::BenchOptions options;
  const std::vector<tact::bench::Command> commands = tact::bench::commands();
  const tact::bench::Command* chosen = nullptr;
  for (const tact::bench::Command& command : commands) {
    CLI::App& sub = *program.add_subcommand(command.name, command.description);
    sub.add_flag("--quick", options.quick, "A short run that exercises everything and measures little");
    sub.add_option("--threads", options.threads, "The most threads to measure with; 0: as many as OpenMP would use")
        ->check(CLI::Range(0, 1024));
    sub.add_option("--out", options.out, "Folder for tables and plots");
    if (command.has_workloads)
      sub.add_option("--only", options.only, "Only workloads whose name holds this text; may be given again");
    sub.callback([&chosen, &command] { chosen = &command; });
  }
  try {
    program.parse(argc, argv);
    if (!chosen) {
      fmt::print("{}", program.help());
      return 0;
    }
    return run(*chosen, options);
  } catch (const CLI::Success& success) {  // --help or --version
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return fail(kWrongUsage, error.what());
  } catch (const std::exception& error) {
    return fail(kFailed, error.what());
  }
}
