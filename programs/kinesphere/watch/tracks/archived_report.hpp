// What a snapshot keeps of reports.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <type_traits>

#include "archive/archive.hpp"
#include "archive/fields.hpp"
#include "formats/streams/source_report.hpp"

namespace kinesphere::program {

/// Writes texts of declarations, or reads them: then they live as long as the program, as there are few.
void archive_texts(auto& archive, auto&... texts) {
  const auto transfer = [&archive](auto& text) {
    std::string copy(text);
    archive(copy);
    if constexpr (!std::is_const_v<std::remove_reference_t<decltype(text)>>) {
      static std::set<std::string> kept;
      text = *kept.insert(copy).first;
    }
  };
  (transfer(texts), ...);
}

void serialize(Some<DeclaredError> auto& self, auto& archive) {
  auto& [bound, declaration] = self;
  archive(bound);
  archive_texts(archive, declaration);
}

/// Leaves out what is valid during a call alone, what the format says once for all, and what recordings add.
void serialize(Some<SourceReport> auto& self, auto& archive) {
  auto& [id, name, stamp, arrival, time_kind, geographic, in_metres, position, has_height, may_have_height,
         on_ground, velocity, has_climb, position_error, height_error, velocity_error, climb_error,
         stamp_error, velocity_age, velocity_spread, extent, ground_speed, said_status, said_kind, sayable,
         ruled_class, row, written, category, craft_type, status, same_within] = self;
  archive(stamp, arrival, time_kind, geographic, in_metres, position, has_height, may_have_height, on_ground,
          velocity, has_climb, position_error, height_error, velocity_error, climb_error, stamp_error,
          velocity_age, velocity_spread, extent, ground_speed, said_status, said_kind, ruled_class,
          same_within);
}

}  // namespace kinesphere::program
