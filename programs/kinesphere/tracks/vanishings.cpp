// Places at which a body appeared or vanished, and who else was there before or afterwards.
#include "tracks/vanishings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>

#include "geography/flat_length.hpp"

namespace kinesphere::program {
namespace {

/// The place of a first or last sample.
struct EndPlace {
  const RecordedTrack* track;
  TrackSample sample;
  bool is_first, is_chosen;
};

/// Where a body is closest to a place.
struct Nearest {
  double time, distance;
  bool is_close;
};

/// Steps along all tracks together, at most about so many. More would cost more than the search.
constexpr double most_steps = 4e6;

/// Places in square cells of the plane of x and y.
class PlaceGrid {
 public:
  explicit PlaceGrid(double cell) : cell_(cell), may_have_(std::size_t{1} << filter_bits) {}

  double cell() const { return cell_; }
  void add(const Vec3& at, std::uint32_t place) {
    const std::uint64_t cell = key(column(at.x), column(at.y));
    may_have_[cell >> (64 - filter_bits)] = true;
    cells_[cell].push_back(place);
  }
  /// Calls f for the places within the length of a cell, and for some others.
  template <class F>
  void near(const Vec3& at, F f) const {
    const std::int64_t x = column(at.x), y = column(at.y);
    for (std::int64_t i = x - 1; i <= x + 1; ++i) {
      for (std::int64_t j = y - 1; j <= y + 1; ++j) {
        const std::uint64_t cell = key(i, j);
        if (!may_have_[cell >> (64 - filter_bits)]) continue;
        const auto found = cells_.find(cell);
        if (found == cells_.end()) continue;
        for (const std::uint32_t place : found->second) f(place);
      }
    }
  }

 private:
  std::int64_t column(double x) const { return static_cast<std::int64_t>(std::floor(x / cell_)); }
  /// Different cells may have one key, whose places are then looked at in vain. The first bits are mixed
  /// best.
  static std::uint64_t key(std::int64_t x, std::int64_t y) {
    return (static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u + static_cast<std::uint64_t>(y)) *
           0xd1342543de82ef95u;
  }

  /// Most cells are empty; a megabit tells most of these without a search.
  static constexpr int filter_bits = 20;

  double cell_;
  std::vector<bool> may_have_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

class VanishingSearch {
 public:
  VanishingSearch(const TrackSet& track_set, const ApproachFilter& filter, const Closeness& closeness)
      : track_set_(track_set),
        filter_(filter),
        closeness_(closeness),
        grid_(cell_for(track_set, closeness)),
        has_come_(track_set.presences.size()),
        goes_on_(track_set.presences.size()) {
    for (const Handover& handover : track_set.handovers)
      goes_on_[handover.from] = has_come_[handover.to] = true;
  }

  std::vector<Vanishing> run() {
    for (std::size_t number = 0; number < track_set_.presences.size(); ++number) add_ends(number);
    found_.resize(places_.size());
    if (!places_.empty())
      for (const Presence& presence : track_set_.presences) follow(presence);
    std::vector<Vanishing> all;
    for (const auto& each : found_)
      if (each) all.push_back(*each);
    std::stable_sort(all.begin(), all.end(),
                     [](const Vanishing& a, const Vanishing& b) { return a.distance < b.distance; });
    return all;
  }

 private:
  static double cell_for(const TrackSet& track_set, const Closeness& closeness) {
    double way = 0.0, radius = 0.0;
    for (const RecordedTrack& track : track_set.tracks) {
      radius = std::max(radius, track.radius);
      for (std::size_t k = 1; k < track.samples.size(); ++k)
        way += flat_length(track.samples[k].position - track.samples[k - 1].position);
    }
    return std::max(2.0 * (closeness.distance + 2.0 * radius), 2.0 * way / most_steps);
  }

  bool is_in_window(double time) const {
    return filter_.asked().from <= time && time <= filter_.asked().until;
  }

  /// A body that goes on under another id does not vanish.
  void add_ends(std::size_t number) {
    const Presence& presence = track_set_.presences[number];
    if (presence.tracks == 0) return;
    const RecordedTrack& first = track_set_.tracks[presence.first_track];
    const RecordedTrack& last = track_set_.tracks[presence.first_track + presence.tracks - 1];
    const bool is_chosen = filter_.wants(presence);
    if (!first.reaches_back_to && !has_come_[number]) add({&first, first.samples.front(), true, is_chosen});
    if (!last.reaches_on_to && !goes_on_[number]) add({&last, last.samples.back(), false, is_chosen});
  }
  void add(const EndPlace& place) {
    if (!is_in_window(place.sample.time)) return;
    grid_.add(place.sample.position, static_cast<std::uint32_t>(places_.size()));
    places_.push_back(place);
  }

  void follow(const Presence& presence) {
    const bool is_chosen = filter_.wants(presence);
    for (std::size_t k = 0; k < presence.tracks; ++k) {
      const RecordedTrack& track = track_set_.tracks[presence.first_track + k];
      for (std::size_t step = 1; step < track.samples.size(); ++step)
        follow(track, track.samples[step - 1], track.samples[step], is_chosen);
    }
  }
  void follow(const RecordedTrack& track, const TrackSample& from, const TrackSample& to, bool is_chosen) {
    const Vec3 way = to.position - from.position;
    const auto parts = static_cast<int>(std::ceil(flat_length(way) / (0.5 * grid_.cell()))) + 1;
    for (int part = 0; part <= parts; ++part) {
      grid_.near(from.position + way * (static_cast<double>(part) / parts), [&](std::uint32_t number) {
        const EndPlace& place = places_[number];
        if (place.track->id == track.id || !(is_chosen || place.is_chosen)) return;
        if (place.is_first ? from.time >= place.sample.time : to.time <= place.sample.time) return;
        note(number, track, nearest(place, track, from, to));
      });
    }
  }

  /// Looks at the part of a step in which the body of the place is not there.
  Nearest nearest(const EndPlace& place, const RecordedTrack& track, const TrackSample& from,
                  const TrackSample& to) const {
    const double duration = to.time - from.time, edge = (place.sample.time - from.time) / duration;
    const double low = std::max({0.0, place.is_first ? 0.0 : edge, part_of(filter_.asked().from, from, to)});
    const double high =
        std::min({1.0, place.is_first ? edge : 1.0, part_of(filter_.asked().until, from, to)});
    if (low > high) return {0.0, 0.0, false};
    Vec3 way = to.position - from.position, off = place.sample.position - from.position;
    const double vertical_way = way.z, vertical_off = off.z;
    if (closeness_.vertical) way.z = off.z = 0.0;
    const double square = norm_squared(way);
    const double part = std::clamp(square > 0.0 ? dot(off, way) / square : low, low, high);
    const double time = from.time + part * duration;
    const double distance =
        track_set_.has_rectangles
            ? gap_between(place.track->shape, pose_of(place.sample.position, *place.track, place.sample.time),
                          track.shape,
                          pose_of(from.position + part * (to.position - from.position), track, time))
            : norm(off - part * way) - track.radius - place.track->radius;
    const bool is_level =
        !closeness_.vertical || std::abs(vertical_off - part * vertical_way) <= *closeness_.vertical;
    return {time, distance, is_level && distance <= closeness_.distance};
  }
  static RectanglePose pose_of(const Vec3& position, const RecordedTrack& track, double time) {
    return {position, {}, track.shape.heading_at(time)};
  }
  static double part_of(double time, const TrackSample& from, const TrackSample& to) {
    return (time - from.time) / (to.time - from.time);
  }

  void note(std::uint32_t number, const RecordedTrack& track, const Nearest& nearest) {
    const EndPlace& place = places_[number];
    auto& found = found_[number];
    if (!nearest.is_close || (found && found->distance <= nearest.distance)) return;
    found = Vanishing{.id = place.track->id,
                      .time = place.sample.time,
                      .has_appeared = place.is_first,
                      .other = track.id,
                      .other_time = nearest.time,
                      .distance = nearest.distance};
  }

  const TrackSet& track_set_;
  const ApproachFilter& filter_;
  const Closeness& closeness_;
  PlaceGrid grid_;
  std::vector<bool> has_come_, goes_on_;  ///< by presence: from another id, or as another one
  std::vector<EndPlace> places_;
  std::vector<std::optional<Vanishing>> found_;  ///< by place
};

}  // namespace

std::vector<Vanishing> vanishings_in(const TrackSet& track_set, const ApproachFilter& filter,
                                     const Closeness& closeness) {
  return VanishingSearch(track_set, filter, closeness).run();
}

}  // namespace kinesphere::program
