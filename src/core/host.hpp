// Host is the world around a core: it knows what two bodies that come near are to each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "kinesphere/counters.hpp"
#include "kinesphere/result.hpp"
#include "kinesphere/vec3.hpp"

namespace kinesphere::core {

/// The core calls the functions while it settles changes and while it handles what is due. Times that are
/// returned are never earlier than now. Those later than the own time of a ball (Ball::own) mean no more than
/// that time.
class Host {
 public:
  /// Returns true if linked_with(), unchanged_until() and walls_unchanged_until() may be called by several
  /// threads at a time.
  virtual bool answers_threads() const = 0;
  /// Sets `linked` to those with which the ball is linked, in ascending order: it touches or senses them, or
  /// has been turned back at its sensor distance from them. They concern it wherever they are, until the link
  /// ends.
  virtual void linked_with(std::uint32_t ball, std::vector<std::uint32_t>& linked) = 0;
  /// Moves those of `others` that may ever have to do with the ball to the front, in the same order. Returns
  /// their number.
  virtual std::size_t keep_partners(std::uint32_t ball, std::span<std::uint32_t> others) = 0;
  /// Returns a time before which nothing happens between two neighbours, from what is known of them; now if
  /// reports have to decide.
  virtual double unchanged_until(std::uint32_t a, std::uint32_t b) = 0;
  /// Finds out whether something happens between two neighbours now, with reports if these are needed: those
  /// of two plain balls that are not linked (Ball::plain) are of now. Returns a time before which nothing
  /// more happens between them; infinity if they are to be told to the core as changed. Errors: those of the
  /// reports, after which nothing has changed.
  virtual Result<double> recheck(std::uint32_t a, std::uint32_t b) = 0;
  /// The same of a ball and the walls.
  virtual double walls_unchanged_until(std::uint32_t ball) = 0;
  virtual Result<double> recheck_walls(std::uint32_t ball) = 0;
  /// What a report is for: two that are near each other, or another safe region.
  enum class Reason { near, region };
  /// Gets reports of these balls now, and tells the core (Core::report()). Returns false if one of them has
  /// broken its bound, so that it is to be told to the core as changed. Errors: those of the reports, after
  /// which nothing has changed.
  virtual Result<bool> report(std::span<const std::uint32_t> balls, Reason reason) = 0;
  /// The safe region of a ball in periodic space is now around `centre`. Two balls meet in the images in
  /// which the centres of their safe regions are nearest.
  virtual void note_image(std::uint32_t ball, const Vec3& centre) = 0;
  /// Returns where the core counts what it does for a ball: its searches, and the times that it computes.
  virtual Counters& work_counters(std::uint32_t ball) = 0;

 protected:
  ~Host() = default;
};

}  // namespace kinesphere::core
