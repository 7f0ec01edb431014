#include "scenes/export/chrome_trace.h"

#include <fmt/format.h>

#include <utility>

#include "scenes/commands/json_text.h"

namespace tact::scenes {
namespace {

using Kind = TraceEvent::Kind;

constexpr int kProcess = 1;

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::refresh: return "1 refresh";
    case Kind::detect: return "detect";
    case Kind::sweep: return "2 sweep";
    case Kind::narrow_phase: return "3-6 narrow phase";
    case Kind::pair: return "pair";
    case Kind::hulls: return "3 hulls";
    case Kind::direction: return "4 direction";
    case Kind::cull: return "5 cull";
    case Kind::confirm: return "6 confirm";
    case Kind::range: return "6 range";
    case Kind::small_pairs: return "small pairs";
    case Kind::kdop_separated_pairs: return "separated pairs";
    case Kind::containment: return "containment";
    case Kind::curves: return "curves";
    case Kind::points: return "points";
    case Kind::self_facets: return "facet pairs of bodies with themselves";
    case Kind::self_points: return "points of bodies with themselves";
    case Kind::patches: return "patches";
    case Kind::report: return "7 report";
    case Kind::within_reach: return "pairs within reach";
  }
  return "unknown";
}

bool has_pairs(Kind kind) { return kind == Kind::small_pairs || kind == Kind::kdop_separated_pairs; }
bool has_facet_pairs(Kind kind) { return kind == Kind::pair || kind == Kind::confirm || kind == Kind::range; }

Json nonzero_stats_json(const StepStats& stats) {
  Json json = Json::object();
  const auto add = [&](const char* name, const char* /*text*/, auto value) {
    if (value != 0) json[name] = value;
  };
  for_each_count(stats, add);
  for_each_time(stats, add);
  return json;
}

Json args_json(const TraceEvent& event, const World& world, const StepStats& stats) {
  if (event.kind == Kind::detect) return nonzero_stats_json(stats);
  if (has_pairs(event.kind)) return {{"pairs", event.count}};
  if (event.a == BodyId{}) return Json::object();
  Json json = {{"a", world.name(event.a)}, {"b", world.name(event.b)}};
  if (has_facet_pairs(event.kind)) json["facet_pairs"] = event.count;
  return json;
}

}  // namespace

ChromeTrace::ChromeTrace(std::ostream& out, const std::string& title, int threads) : out_(out) {
  out_ << "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[";
  write_name("process_name", 0, "tact run " + title);
  for (int thread = 0; thread < threads; ++thread) write_name("thread_name", thread, fmt::format("thread {}", thread));
}

void ChromeTrace::write_name(std::string_view what, int thread, const std::string& name) {
  const Json json = {{"name", what}, {"ph", "M"}, {"pid", kProcess}, {"tid", thread}, {"args", {{"name", name}}}};
  out_ << (std::exchange(first_, false) ? "\n" : ",\n") << json_text(json);
}

// A trace has many events: put together here rather than as a tree of JSON values.
void ChromeTrace::write(const Event& event) {
  out_ << fmt::format(
      ",\n{{\"name\":{},\"cat\":\"{}\",\"ph\":\"X\",\"ts\":{:.3f},\"dur\":{:.3f},\"pid\":{},\"tid\":{},"
      "\"args\":{}}}",
      json_text(event.name), event.category, microseconds(event.begin - *start_), microseconds(event.end - event.begin),
      kProcess, event.thread, event.args);
}

double ChromeTrace::microseconds(Time::duration duration) const {
  return std::chrono::duration<double, std::micro>(duration).count();
}

void ChromeTrace::add_step(int step, const Simulation& simulation) {
  if (!start_) start_ = simulation.times().stretches.front().begin;
  add_phases(step, simulation.times());
  for (const TraceEvent& event : simulation.report()->trace()) add_engine_event(event, simulation);
}

void ChromeTrace::add_phases(int step, const DynamicsTimes& times) {
  write({.name = fmt::format("step {}", step),
         .category = "step",
         .begin = times.stretches.front().begin,
         .end = times.stretches.back().end});
  for (const DynamicsTimes::Stretch& stretch : times.stretches)
    write({.name = stretch.name, .category = "scene", .begin = stretch.begin, .end = stretch.end});
}

void ChromeTrace::add_engine_event(const TraceEvent& event, const Simulation& simulation) {
  const World& world = simulation.world();
  const bool of_pairs = has_pairs(event.kind) || event.a != BodyId{};
  std::string name = kind_name(event.kind);
  if (event.kind == Kind::pair) name = fmt::format("{}, {}", world.name(event.a), world.name(event.b));
  write({.name = std::move(name),
         .category = of_pairs ? "pair" : "engine",
         .thread = event.thread,
         .begin = event.begin,
         .end = event.end,
         .args = json_text(args_json(event, world, simulation.report()->stats()))});
}

void ChromeTrace::finish() { out_ << "]}\n"; }

}  // namespace tact::scenes
