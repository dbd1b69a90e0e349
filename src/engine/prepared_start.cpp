#include "engine/prepared_start.hpp"

#include <algorithm>
#include <utility>

#include "number/infinity.hpp"
#include "processor/window_choice.hpp"

namespace kinesphere {
namespace {

// Parts of the present windows.
constexpr double part_before_slices = 0.02;
/// Before the sort. An earlier sort makes longer swept spheres; but bodies that change after it start at
/// once, without another search at the end. So slices before it and after it take about equally long.
constexpr double part_before_sort = 0.28;
/// For the survey, the choice of cells, the sort and the entry, which take longer than any other slice.
constexpr double part_for_sort = 0.18;
/// Smaller slices make frames more even.
constexpr std::size_t bodies_in_a_slice = 128;
constexpr std::size_t least_slices = 4;
constexpr std::size_t most_slices = 128;
/// Minimum pairs of searches per parallel chunk; below this, dispatch costs more than the work.
constexpr std::size_t searches_at_once = 256;

/// Makes the world choose windows by the policy of the next ones as long as this object lives.
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
      begin_(now + part_before_slices * (present.end - now)),
      slices_(std::clamp<std::size_t>(bodies / bodies_in_a_slice, least_slices, most_slices)),
      policy_(policy),
      next_(space) {}

double PreparedStart::entry_time() const { return time_of(entry_slice()); }

double PreparedStart::next_slice() const { return is_done() ? infinity : time_of(slice_); }

/// Returns the time of a slice. Those of the sort are as far from each other as possible, so that a frame has
/// few.
double PreparedStart::time_of(std::size_t slice) const {
  if (slice == last_slice()) return end();
  const auto part = [](std::size_t slices, std::size_t all) {
    return static_cast<double>(slices) / static_cast<double>(all);
  };
  constexpr double part_entered = part_before_sort + part_for_sort;
  double done = part_before_sort * part(slice, slices_);
  if (slice > entry_slice()) {
    done = part_entered + (1.0 - part_entered) * part(slice - entry_slice() - 1, slices_);
  } else if (slice >= survey_slice()) {
    done = part_before_sort + part_for_sort * part(2 * (slice - survey_slice()) + 1, 8);
  }
  return begin_ + done * (end() - begin_);
}

Result<void> PreparedStart::prepare_slice(const Work& work) {
  work.found.resize(work.lease.count());
  if (slice_ < survey_slice()) {
    if (auto added = add_slice(work); !added) return added;
  } else if (slice_ == survey_slice()) {
    survey(work);
  } else if (slice_ == cells_slice()) {
    next_.choose_cells(work.lease);
  } else if (slice_ == sort_slice()) {
    next_.finish_start(work.lease);
  } else if (slice_ == entry_slice()) {
    enter_windows(work);
  } else if (slice_ < last_slice()) {
    search_slice(work);
  } else {
    finish(work);
  }
  ++slice_;
  return {};
}

void PreparedStart::begin(const Work& work) {
  const RenewalCounts updates = std::exchange(work.main.work().recertified, {});
  work.state.window_policy.start_main(work.main.time(), updates);
  has_begun_ = true;
  next_ = work.state.broad_phase.successor(end(), entry_time(), updates.bodies);
  work.state.broad_phase.record_changes(true);
  numbers_ = static_cast<std::uint32_t>(work.state.bodies.numbers());
}

bool PreparedStart::is_dirty(const Work& work, std::uint32_t number) {
  return work.main.dirty().lists(work.state.bodies, number);
}

/// Returns true if the body starts at end(), with most. Those whose windows end earlier, until which alone
/// they are certified, start by themselves. So do those in windows that are much shorter: from now to the end
/// of the next one, their bounds might grow too much.
bool PreparedStart::starts(const Work& work, std::uint32_t number) const {
  const BroadPhase& present = work.state.broad_phase;
  if (!present.contains(number) || present.end_of(number) != end() || is_dirty(work, number)) return false;
  if (present.window_of(number) == present_) return true;
  const SpeedBound speed_bound = speed_bound_of(BoundAt(work.state.bodies[number].bound, end()));
  return work.state.window_policy.rung_for(speed_bound) >= work.state.window_policy.main_rung();
}

/// Returns the rungs of windows that last beyond end() and hold bodies.
std::vector<int> PreparedStart::lasting_rungs(const Work& work) const {
  std::vector<int> rungs;
  for (const GridLevel& level : work.state.broad_phase.levels())
    if (!level.is_empty() && level.window.end > end()) rungs.push_back(level.window.rung);
  return rungs;
}

/// Makes swept spheres, which are sorted later, for the bodies of a slice.
Result<void> PreparedStart::add_slice(const Work& work) {
  if (!has_begun_) policy_ = work.state.window_policy;
  const PolicySwap swap(work, policy_);
  if (!has_begun_) begin(work);
  update(work);
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t number = begun(slice_); number < begun(slice_ + 1); ++number)
    if (starts(work, number)) numbers.push_back(number);
  WindowStart starting(work.state, work.main, work.lease, work.found, next_, end());
  if (auto probed = starting.refresh(numbers); !probed) return probed;
  std::erase_if(numbers, [&](std::uint32_t number) { return is_dirty(work, number); });
  work.main.work().counters.starts += numbers.size();
  WindowPolicy::Sample slice(work.state.window_policy, true);
  add(work, std::move(numbers), slice);
  work.state.window_policy.add_starters(slice);
  return {};
}

void PreparedStart::add(const Work& work, std::vector<std::uint32_t> numbers, WindowPolicy::Sample& sample) {
  WindowStart choosing(work.state, work.main, work.lease, work.found, next_, end());
  const auto starters = choosing.choose_windows(numbers, lasting_rungs(work), sample);
  WindowStart entering(work.state, work.main, work.lease, work.found, next_, entry_time());
  entering.add_starters(starters);
  entering.hand_over();
}

/// Makes other swept spheres for bodies of earlier slices that have changed since the last slice.
void PreparedStart::update(const Work& work) {
  std::vector<std::uint32_t> again;
  for (const std::uint32_t number : work.state.broad_phase.take_changes()) {
    if (next_.contains(number)) next_.remove_starter(number);
    // A later slice makes the swept spheres of its own bodies.
    if (starts(work, number) && (number >= numbers_ || number < begun(slice_))) again.push_back(number);
  }
  WindowPolicy::Sample uncounted(work.state.window_policy, true);
  add(work, std::move(again), uncounted);
}

/// Takes stock of all next swept spheres.
void PreparedStart::survey(const Work& work) {
  const PolicySwap swap(work, policy_);
  update(work);
  next_.survey(work.lease);
}

/// Enters bodies that have changed since survey() among the sorted ones or, without a spare slot, behind
/// these.
void PreparedStart::enter_changed(const Work& work) {
  const PolicySwap swap(work, policy_);
  const WindowChoice choice(work.state, end());
  for (const std::uint32_t number : work.state.broad_phase.take_changes()) {
    if (starts(work, number)) {
      next_.enter(number, inflated_bound(work.state.bodies, number, entry_time()), entry_time(),
                  choice.window_for(number));
    } else if (next_.contains(number)) {
      next_.leave(number);
    }
  }
}

/// Replaces the present windows.
void PreparedStart::enter_windows(const Work& work) {
  BroadPhase& windows = work.state.broad_phase;
  enter_changed(work);
  windows.record_changes(false);
  for (const std::uint32_t number : work.main.dirty().numbers())
    if (is_dirty(work, number) && next_.contains(number)) next_.leave(number);
  policy_.keep_fast(work.state.window_policy);
  work.state.window_policy = policy_;
  next_ = windows.take_over(std::move(next_));
  ++work.main.work().counters.window_ends;
  work.main.begin_epoch(windows.next_end());
}

/// Returns true if the body has started at entry_time(), and not changed since. A dirty one is certified with
/// all others at this instant.
bool PreparedStart::awaits_search(const Work& work, std::uint32_t number) {
  return work.state.broad_phase.awaits_search(number) && !is_dirty(work, number);
}

/// As awaits_search(), of a pair one of which has started.
bool PreparedStart::pair_awaits_search(const Work& work, std::uint32_t a, std::uint32_t b) {
  return work.state.broad_phase.pair_awaits_search(a, b) && !is_dirty(work, a) && !is_dirty(work, b);
}

/// Returns a part of the bodies that await a search, by number.
std::vector<std::uint32_t> PreparedStart::awaiting_part(const Work& work, std::size_t part) const {
  const std::uint32_t last =
      part < slices_ ? begun(part) : static_cast<std::uint32_t>(work.state.bodies.numbers());
  std::vector<std::uint32_t> awaiting;
  for (std::uint32_t number = begun(part - 1); number < last; ++number)
    if (awaits_search(work, number)) awaiting.push_back(number);
  return awaiting;
}

/// Certifies these starters with the walls, but for those that touch one.
void PreparedStart::find_walls(const Work& work, std::span<const std::uint32_t> starters) {
  if (!work.state.bodies.walls()) return;
  std::vector<std::uint32_t> apart;
  for (const std::uint32_t number : starters)
    (work.state.contacts.walls_of(number) != 0 ? at_walls_ : apart).push_back(number);
  WindowStart(work.state, work.main, work.lease, work.found, work.state.broad_phase, end()).find_walls(apart);
}

/// Searches for a part of the sorted slots, and certifies their pairs but for those of search_alone().
void PreparedStart::search_sorted(const Work& work, std::size_t part) {
  const std::size_t all = next_.started_slots();
  const std::size_t first = all * (part - 1) / slices_;
  const std::size_t last = all * part / slices_;
  const BroadPhase& windows = work.state.broad_phase;
  next_.take_out_started(first, last, [&](std::uint32_t number) { return !windows.awaits_search(number); });
  const PairCertifier certifier(work.state, end(), windows);
  const auto bound_of = [&](std::uint32_t number) {
    return inflated_bound(work.state.bodies, number, end());
  };
  work.lease.parallel_for(
      last - first, searches_at_once, [&](std::size_t from, std::size_t to, std::size_t worker) {
        SearchResults& found = work.found[worker];
        for (const auto& [a, b] : found.search.near_started(next_, first + from, first + to, end(), bound_of))
          if (pair_awaits_search(work, a, b) && !windows.awaits_search_alone(b))
            certifier.certify(a, b, found);
      });
}

/// Searches for those of these starters that are behind the sorted slots, and certifies their pairs. The one
/// with the lesser number finds two of them.
void PreparedStart::search_alone(const Work& work, std::span<const std::uint32_t> starters) {
  const BroadPhase& windows = work.state.broad_phase;
  std::vector<std::uint32_t> alone;
  std::copy_if(starters.begin(), starters.end(), std::back_inserter(alone),
               [&](std::uint32_t number) { return windows.awaits_search_alone(number); });
  const PairCertifier certifier(work.state, end(), windows);
  work.lease.for_each(alone.size(), searches_at_once, [&](std::size_t k, std::size_t worker) {
    const std::uint32_t number = alone[k];
    SearchResults& found = work.found[worker];
    ++found.searches;
    const InflatedBound bound = inflated_bound(work.state.bodies, number, end());
    for (const std::uint32_t other : found.search.near(next_, number, bound, end(), windows.end_of(number)))
      if (pair_awaits_search(work, number, other) && !(windows.awaits_search_alone(other) && other < number))
        certifier.certify(number, other, found);
  });
}

/// Searches for a part of the starters, and certifies them.
void PreparedStart::search_slice(const Work& work) {
  const std::size_t part = slice_ - entry_slice();
  WindowStart starting(work.state, work.main, work.lease, work.found, work.state.broad_phase, end());
  for (SearchResults& found : work.found) found.keeps_linked = true;
  search_sorted(work, part);
  const std::vector<std::uint32_t> starters = awaiting_part(work, part);
  search_alone(work, starters);
  find_walls(work, starters);
  const auto before = static_cast<std::ptrdiff_t>(linked_.size());
  for (SearchResults& found : work.found) {
    near_ += found.near;
    linked_.insert(linked_.end(), found.linked.begin(), found.linked.end());
    found.linked.clear();
    found.keeps_linked = false;
  }
  // Sorted, so that the list does not depend on which thread found which pair.
  std::sort(linked_.begin() + before, linked_.end());
  starting.hand_over();
}

/// Certifies what slices have left to the end.
void PreparedStart::finish(const Work& work) {
  BroadPhase& windows = work.state.broad_phase;
  WindowStart starting(work.state, work.main, work.lease, work.found);
  std::vector<std::uint32_t> started;
  started.reserve(work.state.bodies.numbers());
  for (std::uint32_t number = 0; number < work.state.bodies.numbers(); ++number)
    if (awaits_search(work, number)) started.push_back(number);
  starting.find_links(started);
  const PairCertifier certifier = starting.certifier();
  for (const PairCertificate& pair : linked_)
    if (pair_awaits_search(work, pair.first, pair.second) && !certifier.are_linked(pair.first, pair.second))
      certifier.certify(pair.first, pair.second, work.found.front());
  std::erase_if(at_walls_, [&](std::uint32_t number) { return !awaits_search(work, number); });
  std::copy_if(started.begin(), started.end(), std::back_inserter(at_walls_),
               [&](std::uint32_t number) { return work.state.contacts.walls_of(number) != 0; });
  std::sort(at_walls_.begin(), at_walls_.end());
  at_walls_.erase(std::unique(at_walls_.begin(), at_walls_.end()), at_walls_.end());
  starting.find_walls(at_walls_);
  starting.hand_over();
  windows.end_search();
  const WindowPolicy::Sample last(work.state.window_policy, true);
  work.state.window_policy.finish_start(last, near_, windows.size());
}

bool PreparedStart::is_valid(const WorldState& state) const {
  const std::size_t bodies = state.bodies.numbers();
  const bool is_sorted = slice_ > sort_slice();
  const auto is_number = [=](std::uint32_t number) { return number < bodies; };
  if (!have_entered()) {
    std::vector<bool> has_changed(bodies);
    for (const std::uint32_t number : state.broad_phase.changes()) has_changed[number] = true;
    for (std::uint32_t number = 0; number < bodies; ++number)
      if (next_.contains(number) && !state.bodies[number].present() && !has_changed[number]) return false;
  }
  return present_.is_valid() && present_.end < infinity && begin_ <= end() && begin_ >= -Window::latest_end &&
         slices_ > 0 && slices_ <= most_slices && slice_ <= last_slice() && numbers_ <= bodies &&
         (have_entered() ? next_.is_valid_copy(bodies) && state.broad_phase.search_begin() == end()
                         : next_.is_valid_successor(bodies, survey_slice() < slice_ && !is_sorted,
                                                    cells_slice() < slice_ && !is_sorted) &&
                               (is_sorted ? !next_.has_starters() : next_.started_slots() == 0) &&
                               state.broad_phase.search_begin() == -infinity) &&
         (slice_ == 0 || has_begun_) && policy_.is_valid() &&
         std::all_of(at_walls_.begin(), at_walls_.end(), is_number) &&
         std::all_of(linked_.begin(), linked_.end(), [&](const PairCertificate& pair) {
           return is_number(pair.first) && is_number(pair.second);
         });
}

}  // namespace kinesphere
