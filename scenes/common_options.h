// The options that the commands share.
#pragma once

#include <tact/settings.h>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <string>

namespace tact::scenes {

// --accuracy hulls|paper|exact
void add_accuracy_option(CLI::App& command, Accuracy& accuracy);
// --threads N; 0 stands for as many as OpenMP would use
void add_threads_option(CLI::App& command, int& threads);
// --json FILE, "-" being standard output
void add_json_option(CLI::App& command, std::string& file);
// --record FILE
void add_record_option(CLI::App& command, std::string& file);
// --trace FILE
void add_trace_option(CLI::App& command, std::string& file);

}  // namespace tact::scenes
