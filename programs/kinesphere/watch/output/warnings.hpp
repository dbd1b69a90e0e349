// What a watch warns of: a table of each thing, when it came first, and how often it was so.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "watch/output/watch_view.hpp"

namespace kinesphere::program {

struct WarningRule;
struct WatchFacts;

/// A warning that has been given.
struct Warning {
  std::string_view what;    ///< "order" and so on
  std::string first;        ///< time of the stream at which it was given, as JSON
  std::string text;         ///< as it was given
  std::uint64_t times = 1;  ///< how often it was so until now: reports, tracks, pairs
};

/// Looks after what keeps tracks or pairs from being watched, or makes alerts doubtful, and warns of each
/// thing once, on standard error.
class Warnings {
 public:
  /// `is_recording`: the stream was written before. With `is_quiet` nothing is printed. The view must outlive
  /// the warnings.
  Warnings(const WatchView& watch, bool is_recording, bool is_quiet);

  /// An earlier run has told of all malformed lines so far.
  void pass_over_malformed() { complaints_ = watch_.counts.first_malformed.size(); }
  /// Call after each record.
  void look();
  /// Call once at the end. `has_ended`: the stream has; otherwise the program was asked to stop.
  void look_at_end(bool has_ended);
  /// Warns of what the stream's format has found. `text` names the stream.
  void add(const std::string& text);
  /// Returns the table.
  std::vector<Warning> all();

 private:
  struct Given {
    const WarningRule* rule;  ///< null: by the format
    Warning warning;
  };
  WatchFacts facts();
  void look_by(const WatchFacts& facts);
  void print(std::string_view text) const;

  const WatchView& watch_;
  bool is_recording_, is_quiet_;
  std::size_t complaints_ = 0;                           ///< malformed lines that were told
  std::uint64_t taken_before_ = 0, too_old_before_ = 0;  ///< at the last report that was taken
  std::vector<const WarningRule*> pending_;              ///< rules that have not warned yet
  std::vector<Given> given_;
};

}  // namespace kinesphere::program
