// NearTracks holds a region for each track, a ball of space that does not move, and knows which tracks are
// near each other: those whose regions touch. A track about which reports contradict each other has several.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/balls.hpp"
#include "core/neighbour_lists.hpp"
#include "core/region_cells.hpp"
#include "kinesphere/bound.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere {

struct Region {
  Vec3 centre{};
  double radius = 0.0;  ///< length, > 0
};

class NearTracks {
 public:
  /// Of two tracks: true if it matters whether they are near each other. Empty: it always does.
  using Matter = std::function<bool(std::uint32_t, std::uint32_t)>;

  /// Coordinates are at most 2^41 tolerances (length).
  NearTracks(double tolerance, int dimensions);

  /// Gives a track these regions in place of those that it has. All tracks whose regions touch them, and
  /// perhaps some that are hardly apart, are near it now, if they matter; fresh() lists the new ones. Those
  /// that no longer touch are still near, but gone() lists them. Returns how many touch, whether they matter
  /// or not. Cost: a search in the cells around.
  std::size_t place(std::uint32_t track, std::span<const Region> regions, const Matter& matter);
  /// What the last place() found, until the next one.
  const std::vector<std::uint32_t>& fresh() const { return fresh_; }
  const std::vector<std::uint32_t>& gone() const { return gone_; }
  /// Two tracks that are near each other are no longer so, until the regions of one of them are placed again.
  void part(std::uint32_t a, std::uint32_t b);
  /// Two tracks are near each other, although their regions do not touch.
  void join(std::uint32_t a, std::uint32_t b);
  /// Removes a track, which may have no regions.
  void remove(std::uint32_t track);

  /// Returns the tracks near a track, in any order, until the next change.
  std::span<const std::uint32_t> near(std::uint32_t track) const;
  bool are_near(std::uint32_t a, std::uint32_t b) const;
  /// Returns true if the regions of two tracks touch, as place() finds it.
  bool touch(std::uint32_t a, std::uint32_t b) const;
  /// Returns the k-th region of a track, which contains the one that was given. Precondition: it has one.
  Region region(std::uint32_t track, std::size_t k) const;
  /// Sets a ball that contains the track until `until`, if its k-th region does, for meetings().
  void set_zone(std::uint32_t track, std::size_t k, const Bound& zone, double until);
  struct Meeting {
    std::uint32_t track;
    double apart;  ///< The zones certainly do not touch for so long (time, >= 0).
  };
  /// Returns the tracks near a track whose zones may touch a zone of it within `duration` from now. One may
  /// occur several times. Valid until the next call. Cost: some nanoseconds for each track that is near.
  std::span<const Meeting> meetings(std::uint32_t track, double now, double duration);

  /// Serializes the regions. After reading, rebuild() has to find who is near.
  static void serialize(auto& self, auto& archive) {
    if constexpr (std::is_const_v<std::remove_reference_t<decltype(self)>>) {
      archive(self.saved());
    } else {
      archive(self.read_);
    }
  }
  /// Finds out who is near whom by the regions that were read. Returns false if those are impossible, or if
  /// a track has another number of them than count_of(track), which is 0 from the number `tracks` on.
  bool rebuild(std::size_t tracks, const std::function<std::size_t(std::uint32_t)>& count_of,
               const Matter& matter);

 private:
  static constexpr std::uint32_t none = core::none;
  /// A region as it is in cells_ (units), and its zone.
  struct Saved {
    std::array<float, 3> centre{};
    float radius = 0.0F;
    Bound zone{};
  };
  struct Track {
    std::uint32_t first_ball = none;  ///< its other ones follow in next_
    std::uint32_t list = none;        ///< of those near it
  };

  Saved in_units(const Region& region) const;
  void enter(std::uint32_t track, const Saved& region);
  std::uint32_t ball_of(std::uint32_t track, std::size_t k) const;
  void leave(std::uint32_t track);
  void find(std::uint32_t track);
  void find_meetings(std::uint32_t ball, std::span<const std::uint32_t> others, double duration);
  std::vector<std::vector<Saved>> saved() const;

  double tolerance_;
  double unit_;  ///< length of a unit of cells_, in which centres and reaches are: 2^20 tolerances or less
  core::Balls balls_;
  core::RegionCells cells_;
  core::NeighbourLists lists_;
  std::vector<Track> tracks_;
  // By ball: its track, and the next ball of that; unused balls follow free_ball_.
  std::vector<std::uint32_t> track_of_, next_;
  std::uint32_t free_ball_ = none;
  bool several_ = false;                  ///< Some track has ever had several regions.
  std::vector<std::vector<Saved>> read_;  ///< from a snapshot, until rebuild()
  core::RegionSearch search_;
  std::vector<std::uint32_t> found_, fresh_, gone_;
  std::vector<Meeting> meetings_;
};

}  // namespace kinesphere
