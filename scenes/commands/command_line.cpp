#include "scenes/commands/command_line.h"

#include <fmt/format.h>
#include <tact/error.h>
#include <tact/version.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <string_view>

#include "scenes/commands/check_command.h"
#include "scenes/commands/replay_command.h"
#include "scenes/commands/run_command.h"
#include "scenes/commands/scenes_command.h"
#include "scenes/commands/standard_error.h"
#include "scenes/commands/usage_error.h"
#include "scenes/commands/view_command.h"
#include "scenes/files/file_error.h"

namespace tact::scenes {
namespace {

constexpr int kBadInput = 1;
constexpr int kWrongUsage = 2;

int fail(int status, const std::string& message) {
  print_error(message);
  return status;
}

int fail_usage(const std::string& message) { return fail(kWrongUsage, message + " (see tact --help)"); }

// The subcommand that `argv` names, or the program.
const CLI::App& command_of(const CLI::App& program, int argc, const char* const* argv) {
  for (const CLI::App* const command : program.get_subcommands([](const CLI::App*) { return true; })) {
    if (std::any_of(argv + 1, argv + argc, [&](const char* argument) { return command->check_name(argument); }))
      return *command;
  }
  return program;
}

// CLI11 takes whatever stands after an option that needs a value, be it the next option.
void refuse_options_as_values(const CLI::App& program, int argc, const char* const* argv) {
  if (argc < 1) return;
  const CLI::App& command = command_of(program, argc, argv);
  const auto option_named = [&](const std::string& argument) {
    return argument.starts_with('-') ? command.get_option_no_throw(argument) : nullptr;
  };
  for (int i = 1; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const CLI::Option* const option = option_named(argv[i]);
    if (option == nullptr) continue;
    const int end = std::min(i + option->get_items_expected_min(), argc - 1);
    for (int k = i + 1; k <= end; ++k) {
      if (std::string_view(argv[k]).starts_with("--") || option_named(argv[k]) != nullptr)
        throw UsageError(fmt::format("{}: its value is missing; {} is taken for an option", argv[i], argv[k]));
    }
    i = end;
  }
}

// To parse a command is to run it.
int parse(CLI::App& program, int argc, const char* const* argv) {
  try {
    refuse_options_as_values(program, argc, argv);
    program.parse(argc, argv);
    return program.get_subcommands().empty() ? fail_usage("no command") : 0;
  } catch (const CLI::Success& success) {  // --help or --version
    return program.exit(success);
  } catch (const CLI::ParseError& error) {
    return fail_usage(error.what());
  } catch (const UsageError& error) {
    return fail_usage(error.what());
  } catch (const FileError& error) {
    return fail(kBadInput, error.what());
  } catch (const Error& error) {
    return error.code() == ErrorCode::bad_settings ? fail_usage(error.what()) : fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kBadInput, "out of memory");
  } catch (const std::exception& error) {  // such as a file system that fails
    return fail(kBadInput, error.what());
  }
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
  open_standard_streams();
  CLI::App program("Finds where many deformable bodies touch.", "tact");
  program.set_version_flag("--version", "tact " TACT_VERSION, "Print the version and exit");
  program.footer(
      "Exit status: 0 done; 1 the input is bad, or a file or standard output cannot be written; 2 wrong usage.\n"
      "`tact COMMAND --help` tells about a command.");
  add_check_command(program);
  add_run_command(program);
  add_replay_command(program);
  add_view_command(program);
  add_scenes_command(program);
  const int status = parse(program, argc, argv);
  // What was printed may still wait in a buffer.
  if (status == 0 && !std::cout.flush()) return fail(kBadInput, "standard output: cannot be written to its end");
  return status;
}

}  // namespace tact::scenes
