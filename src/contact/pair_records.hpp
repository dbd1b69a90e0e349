// PairRecords holds what is remembered of pairs of bodies beside their contacts and overlaps: the caller's
// state of the pair, and the sensor distance at which a response has turned the two back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace kinesphere {

struct PairRecord {
  std::uint32_t partner = 0;
  std::int32_t state = 0;  ///< World::set_pair_state()
  /// The two have come to this sensor distance (length) and have been turned back. They may still be a little
  /// beyond it. Negative if there is none.
  double turned_at = -1.0;

  bool is_turned() const { return turned_at >= 0.0; }
  friend bool operator==(const PairRecord&, const PairRecord&) = default;
};

/// Each of the two bodies has the record of the other, as long as there is something to remember. A body that
/// never had one costs no memory, or 24 bytes if a body with a larger number had one. Cost of each call:
/// O(records of a body).
class PairRecords {
 public:
  std::span<const PairRecord> of(std::uint32_t body) const {
    return body < lists_.size() ? std::span<const PairRecord>(lists_[body]) : std::span<const PairRecord>();
  }
  /// Returns nullptr if nothing is remembered of the two.
  const PairRecord* find(std::uint32_t a, std::uint32_t b) const;
  std::int32_t state(std::uint32_t a, std::uint32_t b) const {
    const PairRecord* const record = find(a, b);
    return record != nullptr ? record->state : 0;
  }
  bool are_turned(std::uint32_t a, std::uint32_t b) const {
    const PairRecord* const record = find(a, b);
    return record != nullptr && record->is_turned();
  }
  bool has_turned(std::uint32_t body) const;

  void set_state(std::uint32_t a, std::uint32_t b, std::int32_t state);
  void set_turned(std::uint32_t a, std::uint32_t b, std::optional<double> distance);
  /// Forgets that the body has been turned back anywhere.
  void forget_turns(std::uint32_t body);
  /// Forgets all of the body.
  void forget(std::uint32_t body);

  static void serialize(auto& self, auto& archive) { archive(self.lists_); }
  /// Validates records that were read from bytes, for a world of `bodies` bodies.
  bool is_valid(std::size_t bodies) const;

 private:
  void keep(std::uint32_t a, std::uint32_t b, const PairRecord& record);
  void keep_half(std::uint32_t body, const PairRecord& record);

  std::vector<std::vector<PairRecord>> lists_;  ///< by body, up to the last one that ever had a record
};

}  // namespace kinesphere
