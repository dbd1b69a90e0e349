// The classes of the tracks of a watch, and the choice of one for each report.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "formats/fields/wrong_input.hpp"
#include "formats/streams/source_report.hpp"
#include "watch/tracks/motion_classes.hpp"
#include "watch/tracks/track_names.hpp"

namespace kinesphere::program {

/// One --class.
struct ClassRule {
  std::size_t motion_class = 0;  ///< an index of TrackClasses
  std::string expression;        ///< over the columns of a table, or over fields of reports; or
  std::shared_ptr<const std::unordered_set<std::string>> ids;  ///< in lower case
};

/// Class 0 is the default. Then come those of --class, and then those that the stream may say.
class TrackClasses {
 public:
  explicit TrackClasses(const MotionLimits& by_default = {}) : classes_{{.name = {}, .limits = by_default}} {}

  /// Adds a class of --class, and returns its index; one that is there already is not added again.
  std::size_t add(const MotionClass& named);
  /// Adds the classes that the stream may say; only the first call does so.
  void begin(std::span<const MotionPreset> sayable);

  /// Returns the index of the class of a report: the first one of the report's that its speed allows, else
  /// the default. `known`: the track before it; null: none.
  ///
  /// A status is set by hand and often wrong. So a class of craft at rest takes a reported speed, no larger
  /// than MotionClass::given_up_to, or kept_up_to if the track is in it. Where a speed has contradicted it,
  /// it is not given again for 300 s. Other classes are passed over only if the default allows a larger
  /// speed.
  std::size_t choose(const SourceReport& report, const NamedTrack* known) const;
  /// True if the report says that its craft is at rest, and its speed contradicts this.
  bool contradicts_rest(const SourceReport& report) const;

  const MotionClass& operator[](std::size_t index) const { return classes_[index]; }
  std::size_t size() const { return classes_.size(); }
  /// Returns the largest horizontal speed of all classes.
  double fastest() const;
  /// Returns the limits of a class for alerts, with its name.
  std::string promise(std::size_t index) const;
  /// Returns the limits of a pair of classes for alerts.
  std::string promise(std::size_t first, std::size_t second) const;

  /// Archives what begin() has added; it is read into an object with equal classes of --class.
  static void serialize(auto& self, auto& archive) {
    std::vector<MotionPreset> sayable = self.sayable_;
    bool has_begun = self.has_begun_;
    archive(sayable, has_begun);
    if constexpr (requires { self.begin(sayable); }) {
      for (const MotionPreset preset : sayable)
        if (static_cast<std::size_t>(preset) >= preset_count)
          throw WrongInput("expected classes in the snapshot");
      if (has_begun) self.begin(sayable);
    }
  }

 private:
  /// Indices of the classes of a report in the order of their precedence; 0: none.
  std::array<std::size_t, 3> said(const SourceReport& report) const;
  bool allows(std::size_t index, const SourceReport& report, const NamedTrack* known) const;

  std::vector<MotionClass> classes_;
  std::array<std::size_t, preset_count> automatic_{};  ///< indices, 0 for a preset that is no class
  std::vector<MotionPreset> sayable_;
  bool has_begun_ = false;
};

}  // namespace kinesphere::program
