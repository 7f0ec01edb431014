#include "scenes/commands/common_options.h"

#include <CLI/Validators.hpp>
#include <map>

namespace tact::scenes {
namespace {

// An option that names a file; `what` goes there and not to standard output.
void add_file_option(CLI::App& command, const std::string& option, std::string& file, const std::string& what,
                     const std::string& text) {
  const auto check = [what](const std::string& name) {
    return name == "-" ? what + " goes to a file, not to standard output" : std::string();
  };
  command.add_option(option, file, text)->type_name("FILE")->check(refuse_empty_name)->check(check);
}

}  // namespace

std::string refuse_empty_name(const std::string& name) { return name.empty() ? "the name is empty" : ""; }

void add_accuracy_option(CLI::App& command, Accuracy& accuracy) {
  const std::map<std::string, Accuracy> names = {
      {"hulls", Accuracy::hulls}, {"paper", Accuracy::paper}, {"exact", Accuracy::exact}};
  const auto parse = [&accuracy, names](const std::string& text) { accuracy = names.at(text); };
  command.add_option_function<std::string>("--accuracy", parse, "What is promised of each pair; exact if not given")
      ->type_name("hulls|paper|exact")
      ->check(CLI::IsMember({"hulls", "paper", "exact"}).description(""));
}

void add_threads_option(CLI::App& command, int& threads) {
  constexpr int kMost = 1024;
  command.add_option("--threads", threads, "How many threads to use; 0, if not given: as many as OpenMP would")
      ->type_name("N")
      ->check(CLI::Range(0, kMost).description(""));
}

void add_json_option(CLI::App& command, std::string& file) {
  command
      .add_option("--json", file,
                  "Write the report as JSON to this file; - is standard output, and nothing else goes there")
      ->type_name("FILE|-")
      ->check(refuse_empty_name);
}

void add_record_option(CLI::App& command, std::string& file) {
  add_file_option(command, "--record", file, "a recording",
                  "Write all that enters the engine to this file, for `tact replay`");
}

void add_trace_option(CLI::App& command, std::string& file) {
  add_file_option(command, "--trace", file, "a trace",
                  "Write which thread did what and when to this file, for ui.perfetto.dev or chrome://tracing");
}

}  // namespace tact::scenes
