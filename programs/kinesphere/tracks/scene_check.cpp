// Finds tables with several scenes whose bodies cannot meet.
#include "tracks/scene_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "base/program_error.hpp"
#include "formats/tables/column_names.hpp"
#include "formats/tables/row_filter.hpp"

namespace kinesphere::program {

void SceneCheck::add(std::string_view column, std::string_view scene, const FileTime& time) {
  auto scenes = columns_.find(column);
  if (scenes == columns_.end()) scenes = columns_.emplace(column, decltype(scenes->second){}).first;
  auto span = scenes->second.find(scene);
  if (span == scenes->second.end()) span = scenes->second.emplace(scene, Span{time, time}).first;
  if (is_earlier(time, span->second.first)) span->second.first = time;
  if (is_earlier(span->second.last, time)) span->second.last = time;
}

void SceneCheck::ask(const std::string& file) const {
  for (const auto& [column, scenes] : columns_) {
    std::vector<std::pair<std::string, Span>> ordered(scenes.begin(), scenes.end());
    std::sort(ordered.begin(), ordered.end(),
              [](const auto& a, const auto& b) { return is_earlier(a.second.first, b.second.first); });
    const bool are_zones = hints_at(column, NameHint::zone);
    std::size_t latest = 0;
    for (std::size_t k = 1; k < ordered.size(); ++k) {
      if (!are_zones && !is_earlier(ordered[k].second.first, ordered[latest].second.last)) {
        latest = k;
        continue;
      }
      const std::string name = name_in_filter(column);
      throw ProgramError(
          fmt::format("{}: the rows with {} as '{}' and '{}' {}: take one with --where '{} = {}', or all as "
                      "one with --where '{} != none'",
                      file, column, ordered[latest].first, ordered[k].first,
                      are_zones ? "may have coordinates or times that cannot be compared"
                                : "have the same times, so that they may be different scenes",
                      name, name_in_filter(ordered[latest].first), name));
    }
  }
}

}  // namespace kinesphere::program
