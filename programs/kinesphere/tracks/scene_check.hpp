// Finds tables with several scenes whose bodies cannot meet.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "formats/fields/time_text.hpp"

namespace kinesphere::program {

/// Gathers the times of each value of a column such as scene_id. The scenes of a table that are at the same
/// times are different places or trials.
class SceneCheck {
 public:
  void add(std::string_view column, std::string_view scene, const FileTime& time);
  /// Throws ProgramError naming two scenes of one column that have the same times, or two zones at any times.
  void ask(const std::string& file) const;

 private:
  struct Span {
    FileTime first, last;
  };
  std::map<std::string, std::map<std::string, Span, std::less<>>, std::less<>> columns_;
};

}  // namespace kinesphere::program
