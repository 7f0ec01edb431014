#include "scenes/files/pvd_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>

#include "scenes/files/text_reader.h"
#include "scenes/files/xml_reader.h"

namespace tact::scenes {
namespace {

double time_of(const XmlTag& tag, const XmlReader& xml) {
  const std::string* const text = tag.attribute("timestep");
  if (text == nullptr) return 0.0;
  const std::optional<double> time = parse_number(*text);
  if (!time || !std::isfinite(*time)) xml.fail(fmt::format("the timestep is {}, not a number", in_quotes(*text)));
  return *time;
}

void sort_by_time(PvdPart& part) {
  std::vector<std::size_t> order(part.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t i, std::size_t k) { return part.times[i] < part.times[k]; });
  PvdPart sorted;
  for (const std::size_t i : order) {
    sorted.files.push_back(part.files[i]);
    sorted.times.push_back(part.times[i]);
  }
  part = std::move(sorted);
}

}  // namespace

std::vector<PvdPart> parse_pvd(std::string_view bytes, const std::filesystem::path& file) {
  XmlReader xml(bytes, file.string());
  std::vector<PvdPart> parts;
  std::vector<std::string> names;
  const auto first = xml.next();
  if (!first || first->name != "VTKFile") xml.fail("expected <VTKFile>");
  if (const std::string& type = xml.required(*first, "type"); type != "Collection")
    xml.fail(in_quotes(type) + ": a .pvd file is a Collection");
  while (const auto tag = xml.next()) {
    if (tag->name != "DataSet" || tag->kind == XmlTag::Kind::close) continue;
    xml.set_place(tag->line);
    const std::string* const given = tag->attribute("part");
    const std::string name = given != nullptr ? *given : "0";
    const auto place = static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
    if (place == names.size()) {
      names.push_back(name);
      parts.emplace_back();
    }
    const std::string& named = xml.required(*tag, "file");
    if (std::any_of(named.begin(), named.end(), [](char c) { return (c >= 0 && c < ' ') || c == 0x7f; }))
      xml.fail(in_quotes(named) + " is no name of a file");
    parts[place].files.push_back(file.parent_path() / named);
    parts[place].times.push_back(time_of(*tag, xml));
  }
  if (parts.empty()) xml.fail("the collection names no file");
  for (PvdPart& part : parts) sort_by_time(part);
  for (std::size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].times != parts[0].times)
      xml.fail(fmt::format("part {} has other times than part {}", in_quotes(names[i]), in_quotes(names[0])));
  }
  return parts;
}

}  // namespace tact::scenes
