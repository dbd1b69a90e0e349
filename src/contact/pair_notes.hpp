// PairNotes holds what is remembered of pairs of bodies beside their contacts and overlaps: the caller's
// state of the pair, and the sensor distance at which a response has turned the two back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace kinesphere {

struct PairNote {
  std::uint32_t partner = 0;
  std::int32_t state = 0;  ///< World::set_pair_state()
  /// The two have come to this sensor distance (length) and have been turned back. They may still be a little
  /// beyond it. Negative if there is none.
  double turned_at = -1.0;

  bool is_turned() const { return turned_at >= 0.0; }
  friend bool operator==(const PairNote&, const PairNote&) = default;
};

/// Each of the two bodies has the note of the other, as long as there is something to remember. A body that
/// never had one costs no memory, or 24 bytes if a body with a larger number had one. Cost of each call:
/// O(notes of a body).
class PairNotes {
 public:
  std::span<const PairNote> of(std::uint32_t body) const {
    return body < lists_.size() ? std::span<const PairNote>(lists_[body]) : std::span<const PairNote>();
  }
  /// Returns what `a` remembers of the two; a note without a state or a turn if that is nothing.
  PairNote between(std::uint32_t a, std::uint32_t b) const {
    const PairNote* const note = find(a, b);
    return note != nullptr ? *note : PairNote{b};
  }
  bool has_turned(std::uint32_t body) const;

  void set_state(std::uint32_t a, std::uint32_t b, std::int32_t state);
  void set_turned(std::uint32_t a, std::uint32_t b, std::optional<double> distance);
  /// Sets the notes of a body alone. Those of its partners have to be set alike.
  void set_of(std::uint32_t body, std::vector<PairNote> notes);
  /// Forgets that the body has been turned back anywhere.
  void forget_turns(std::uint32_t body);
  /// Forgets all of the body.
  void forget(std::uint32_t body);

  static void serialize(auto& self, auto& archive) { archive(self.lists_); }
  /// Validates notes that were read from bytes, for a world of `bodies` bodies.
  bool is_valid(std::size_t bodies) const;

 private:
  const PairNote* find(std::uint32_t a, std::uint32_t b) const {
    for (const PairNote& note : of(a))
      if (note.partner == b) return &note;
    return nullptr;
  }
  void keep(std::uint32_t a, const PairNote& note);
  void keep_half(std::uint32_t body, const PairNote& note);

  std::vector<std::vector<PairNote>> lists_;  ///< by body, up to the last one that ever had a note
};

}  // namespace kinesphere
