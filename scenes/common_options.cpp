#include "scenes/common_options.h"

#include <CLI/Validators.hpp>
#include <map>

namespace tact::scenes {

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
  command.add_option("--threads", threads, "How many threads to use; 0, if not given: one a core")
      ->type_name("N")
      ->check(CLI::Range(0, kMost).description(""));
}

void add_json_option(CLI::App& command, std::string& file) {
  command
      .add_option("--json", file,
                  "Write the report as JSON to this file; - is standard output, and nothing else goes there")
      ->type_name("FILE|-");
}

void add_record_option(CLI::App& command, std::string& file) {
  const auto check = [](const std::string& name) {
    return name == "-" ? std::string("a recording goes to a file, not to standard output") : std::string();
  };
  command.add_option("--record", file, "Write all that enters the engine to this file, for `tact replay`")
      ->type_name("FILE")
      ->check(check);
}

}  // namespace tact::scenes
