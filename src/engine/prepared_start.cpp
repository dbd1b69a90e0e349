#include "engine/prepared_start.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <utility>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Part of the present windows in which the next start is prepared. In a longer part more bodies change after
/// they were prepared; in a shorter one frames differ more.
constexpr double part_for_preparation = 0.85;
// Parts of that, about as long as the work takes. Changes cost least before the sort.
constexpr double part_for_spheres = 0.5;
constexpr double part_for_sort = 0.1;
/// Smaller slices make frames more even. Each slice also goes through the bodies that have changed.
constexpr std::size_t bodies_in_a_slice = 256;
constexpr std::size_t least_slices = 4;
constexpr std::size_t most_slices = 64;

void sort_unique(std::vector<std::uint32_t>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// While it lives, the world chooses windows by the policy of the prepared ones.
class PolicySwap {
 public:
  PolicySwap(const PreparedStart::Work& work, WindowPolicy& policy)
      : present_(work.state.window_policy), policy_(policy) {
    std::swap(present_, policy_);
  }
  ~PolicySwap() { std::swap(present_, policy_); }
  PolicySwap(const PolicySwap&) = delete;
  PolicySwap& operator=(const PolicySwap&) = delete;

 private:
  WindowPolicy& present_;
  WindowPolicy& policy_;
};

}  // namespace

PreparedStart::PreparedStart(const Space& space, const WindowPolicy& policy, const Window& present,
                             double now, std::size_t bodies)
    : present_(present),
      begin_(present.end - part_for_preparation * (present.end - now)),
      slices_(std::clamp<std::size_t>(bodies / bodies_in_a_slice, least_slices, most_slices)),
      policy_(policy),
      next_(space) {}

double PreparedStart::next_slice() const {
  const auto part = [this](std::size_t slices) {
    return static_cast<double>(slices) / static_cast<double>(slices_);
  };
  double done = 0.0;
  if (slice_ < slices_) {
    done = part_for_spheres * part(slice_);
  } else if (slice_ == slices_) {
    done = part_for_spheres + 0.5 * part_for_sort;
  } else if (slice_ <= 2 * slices_) {
    done = part_for_spheres + part_for_sort +
           (1.0 - part_for_spheres - part_for_sort) * part(slice_ - slices_ - 1);
  } else {
    return infinity;
  }
  return begin_ + (end() - begin_) * done;
}

Result<void> PreparedStart::prepare_slice(const Work& work) {
  if (!has_begun_) policy_ = work.state.window_policy;
  const PolicySwap swap(work, policy_);
  work.found.resize(work.lease.count());
  if (!has_begun_) begin(work);
  return do_slice(work);
}

Result<void> PreparedStart::do_slice(const Work& work) {
  update(work);
  if (slice_ < slices_) {
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t number = begun(slice_); number < begun(slice_ + 1); ++number)
      if (starts(work, number)) numbers.push_back(number);
    if (auto added = add(work, std::move(numbers)); !added) return added;
  } else if (slice_ == slices_) {
    next_.finish_start(work.lease);
    ++slice_;
    sort_unique(waiting_);
    enter(work, std::exchange(waiting_, {}));
    return {};
  } else {
    search_slots(work, next_.started_slots() * (slice_ - slices_) / slices_);
  }
  ++slice_;
  return {};
}

void PreparedStart::begin(const Work& work) {
  work.state.window_policy.start_main(work.main.time(), std::exchange(work.main.work().recertified, {}));
  has_begun_ = true;
  next_ = work.state.broad_phase.successor(end());
  work.state.broad_phase.record_changes(true);
  numbers_ = static_cast<std::uint32_t>(work.state.bodies.numbers());
}

/// Returns true if the body is in a window that lasts beyond end().
bool PreparedStart::lasts(const Work& work, std::uint32_t number) const {
  const BroadPhase& present = work.state.broad_phase;
  return present.contains(number) && present.end_of(number) > end();
}

/// Returns true if the body starts at end(), with most. Bodies in windows that are much shorter start when
/// these end: from now to the end of the next one, their bounds might grow too much.
bool PreparedStart::starts(const Work& work, std::uint32_t number) const {
  const BroadPhase& present = work.state.broad_phase;
  if (!present.contains(number) || present.end_of(number) > end() || work.state.bodies[number].dirty)
    return false;
  if (present.window_of(number) == present_) return true;
  const SpeedBound speed_bound = speed_bound_of(BoundAt(work.state.bodies[number].bound, end()));
  return work.state.window_policy.rung_for(speed_bound) >= work.state.window_policy.main_rung();
}

/// Makes swept spheres, which are sorted later, for the bodies of a slice.
Result<void> PreparedStart::add(const Work& work, std::vector<std::uint32_t> numbers) {
  WindowStart starting = start(work);
  if (auto probed = starting.refresh(numbers); !probed) return probed;
  std::erase_if(numbers, [&](std::uint32_t number) { return work.state.bodies[number].dirty; });
  work.main.work().counters.starts += numbers.size();
  WindowPolicy::Sample slice(work.state.window_policy, true);
  starting.add_starters(starting.choose_windows(numbers, next_.held_rungs(), slice));
  work.state.window_policy.add_starters(slice);
  find_walls(work, numbers);
  hand_over(work);
  return {};
}

/// Makes other swept spheres for bodies of earlier slices, which have changed.
void PreparedStart::add_again(const Work& work, std::vector<std::uint32_t> numbers) {
  WindowPolicy::Sample uncounted(work.state.window_policy, true);
  WindowStart starting = start(work);
  starting.add_starters(starting.choose_windows(numbers, next_.held_rungs(), uncounted));
  find_walls(work, numbers);
  hand_over(work);
}

/// Brings the bodies up to date that have changed since the last slice.
void PreparedStart::update(const Work& work) {
  std::vector<std::uint32_t> changed = work.state.broad_phase.take_changes();
  if (is_sorted()) return enter(work, changed);
  std::vector<std::uint32_t> again;
  for (const std::uint32_t number : changed) {
    if (next_.is_starter(number)) {
      next_.remove_starter(number);
    } else if (next_.contains(number)) {
      next_.leave(number);
    }
    // Those of later slices are left to these.
    if (lasts(work, number)) {
      waiting_.push_back(number);
    } else if (starts(work, number) && (number >= numbers_ || number < begun(slice_))) {
      again.push_back(number);
    }
  }
  add_again(work, std::move(again));
}

/// Enters bodies that have changed, and searches for them. Precondition: the others are sorted.
void PreparedStart::enter(const Work& work, std::span<const std::uint32_t> numbers) {
  const double now = work.main.time();
  const WindowChoice choice(work.state, end());
  std::vector<std::uint32_t> entered;
  std::vector<std::uint32_t> started;
  for (const std::uint32_t number : numbers) {
    if (lasts(work, number)) {
      next_.enter(number, inflated_bound(work.state.bodies, number, now), now,
                  work.state.broad_phase.window_of(number));
      entered.push_back(number);
    } else if (starts(work, number)) {
      next_.enter(number, inflated_bound(work.state.bodies, number, end()), end(), choice.window_for(number));
      entered.push_back(number);
      started.push_back(number);
    } else if (next_.contains(number)) {
      next_.leave(number);
    }
  }
  work.main.work().counters.restarts += started.size();
  search(work, entered);
  find_walls(work, started);
  hand_over(work);
}

/// Searches for bodies that have entered one by one, and certifies the pairs that no later slice finds.
void PreparedStart::search(const Work& work, std::span<const std::uint32_t> entered) {
  Bodies& bodies = work.state.bodies;
  const PairCertifier certifier(work.state, end(), next_);
  SearchResults& found = work.found.front();
  found.keeps_linked = true;
  for (const std::uint32_t number : entered) {
    ++found.searches;
    const bool is_lasting = lasts(work, number);
    const InflatedBound bound = inflated_bound(bodies, number, end());
    for (const std::uint32_t other : found.search.near_entered(next_, number, bound, end()))
      if (!bodies[other].visited && !(is_lasting && lasts(work, other)) &&
          !next_.will_find(number, other, searched_))
        certifier.certify(number, other, found);
    bodies[number].visited = true;
  }
  for (const std::uint32_t number : entered) bodies[number].visited = false;
}

/// Searches for the started slots up to `last`.
void PreparedStart::search_slots(const Work& work, std::size_t last) {
  for (SearchResults& found : work.found) found.keeps_linked = true;
  near_ += start(work).find_pairs(searched_, last);
  searched_ = last;
  hand_over(work);
}

/// Certifies bodies with the walls, but for those that touch one.
void PreparedStart::find_walls(const Work& work, std::span<const std::uint32_t> numbers) {
  std::vector<std::uint32_t> apart;
  for (const std::uint32_t number : numbers)
    (work.state.contacts.walls_of(number) != 0 ? at_walls_ : apart).push_back(number);
  start(work).find_walls(apart);
}

void PreparedStart::hand_over(const Work& work) {
  const auto before = static_cast<std::ptrdiff_t>(linked_.size());
  for (SearchResults& found : work.found) {
    linked_.insert(linked_.end(), found.linked.begin(), found.linked.end());
    found.linked.clear();
    found.keeps_linked = false;
  }
  // Sorted, so that the list does not depend on which thread found which pair.
  std::sort(linked_.begin() + before, linked_.end());
  start(work).hand_over();
}

std::vector<std::uint32_t> PreparedStart::complete(const Work& work, std::vector<std::uint32_t>& numbers) {
  const PolicySwap swap(work, policy_);
  work.found.resize(work.lease.count());
  update(work);
  search_slots(work, next_.started_slots());
  // They start with their changes, after the others.
  for (const std::uint32_t number : work.main.dirty().numbers())
    if (work.state.bodies[number].dirty && next_.contains(number) && !lasts(work, number))
      next_.leave(number);
  const auto others = std::stable_partition(numbers.begin(), numbers.end(),
                                            [this](std::uint32_t number) { return next_.contains(number); });
  std::vector<std::uint32_t> started(numbers.begin(), others);
  numbers.erase(numbers.begin(), others);
  return started;
}

void PreparedStart::take_over(const Work& work, std::vector<std::uint32_t> started,
                              std::vector<std::uint32_t>& numbers) {
  assert(is_sorted());
  policy_.keep_fast(work.state.window_policy);
  work.state.window_policy = policy_;
  std::vector<std::uint32_t> joining;
  std::copy_if(numbers.begin(), numbers.end(), std::back_inserter(joining),
               [&](std::uint32_t number) { return starts(work, number); });
  enter(work, joining);
  std::erase_if(numbers, [this](std::uint32_t number) { return next_.contains(number); });
  started.insert(started.end(), joining.begin(), joining.end());
  BroadPhase& windows = work.state.broad_phase;
  windows.take_over(std::move(next_));
  WindowStart starting(work.state, work.main, work.lease, work.found);
  starting.find_links(started);
  const PairCertifier certifier = starting.certifier();
  for (const PairCertificate& pair : linked_)
    if (!certifier.is_stale(pair) && windows.contains(pair.first) && windows.contains(pair.second) &&
        !certifier.are_linked(pair.first, pair.second))
      certifier.certify(pair.first, pair.second, work.found.front());
  std::copy_if(started.begin(), started.end(), std::back_inserter(at_walls_),
               [&](std::uint32_t number) { return work.state.contacts.walls_of(number) != 0; });
  sort_unique(at_walls_);
  std::erase_if(at_walls_, [&](std::uint32_t number) { return !windows.contains(number); });
  starting.find_walls(at_walls_);
  starting.hand_over();
  const WindowPolicy::Sample last(work.state.window_policy, true);
  work.state.window_policy.finish_start(last, near_, windows.size());
}

bool PreparedStart::is_valid(const WorldState& state) const {
  const std::size_t bodies = state.bodies.numbers();
  for (std::uint32_t number = 0; number < bodies; ++number)
    if (next_.contains(number) && !state.bodies[number].present() && !state.broad_phase.has_changed(number))
      return false;
  const auto is_number = [=](std::uint32_t number) { return number < bodies; };
  return present_.is_valid() && present_.end < infinity && begin_ <= end() && begin_ >= -Window::latest_end &&
         slices_ > 0 && slices_ <= most_slices && slice_ <= 2 * slices_ + 1 && numbers_ <= bodies &&
         next_.is_valid(bodies) && (is_sorted() ? !next_.has_starters() : next_.started_slots() == 0) &&
         searched_ <= next_.started_slots() && (slice_ == 0 || has_begun_) && policy_.is_valid() &&
         std::all_of(waiting_.begin(), waiting_.end(), is_number) &&
         std::all_of(at_walls_.begin(), at_walls_.end(), is_number) &&
         std::all_of(linked_.begin(), linked_.end(), [&](const PairCertificate& pair) {
           return is_number(pair.first) && is_number(pair.second);
         });
}

}  // namespace kinesphere
