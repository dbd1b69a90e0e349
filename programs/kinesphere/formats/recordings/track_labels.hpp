// Names of tracks that are called alike.
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>

namespace kinesphere::program {

/// Tells tracks of one name apart: two walks of a day may be called alike, at the same times or not.
class TrackLabels {
 public:
  /// Returns the name for its first track, and "name (2)" and so on for the next.
  std::string label(const std::string& name) {
    const std::size_t count = ++counts_[name];
    return count == 1 ? name : name + " (" + std::to_string(count) + ")";
  }

 private:
  std::unordered_map<std::string, std::size_t> counts_;
};

}  // namespace kinesphere::program
