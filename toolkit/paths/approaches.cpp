#include "kinesphere/approaches.hpp"

#include <algorithm>
#include <tuple>

#include "input/input_check.hpp"
#include "kinesphere/limits.hpp"
#include "number/infinity.hpp"
#include "paths/near_pairs.hpp"
#include "paths/pair_course.hpp"

namespace kinesphere {
namespace {

/// Steps of which the paths are computed together: enough that an arc's coefficients are read once for
/// several steps, and so few that the results stay in the processor's caches.
constexpr std::size_t steps_at_once = 16;

/// Successive steps, from `begin` to before `end`, in which a pair may come near.
struct NearSteps {
  std::uint32_t first, second;
  std::size_t begin, end;

  bool is_continued_by(const NearSteps& next) const {
    return first == next.first && second == next.second && end == next.begin;
  }
};

/// Sorts by pair and time, and joins what follows each other.
void join(std::vector<NearSteps>& all) {
  std::sort(all.begin(), all.end(), [](const NearSteps& a, const NearSteps& b) {
    return std::tie(a.first, a.second, a.begin) < std::tie(b.first, b.second, b.begin);
  });
  std::size_t kept = 0;
  for (const NearSteps& next : all) {
    if (kept > 0 && all[kept - 1].is_continued_by(next)) {
      all[kept - 1].end = next.end;
    } else {
      all[kept++] = next;
    }
  }
  all.resize(kept);
}

/// What one thread needs to search steps.
struct StepSearch {
  StepPaths paths;
  NearPairs pairs;

  StepSearch(const ArcTable& arcs, double distance, const Approaches::Options& options)
      : paths(arcs), pairs(distance, options.body) {}
};

class Search {
 public:
  Search(const ArcTable& arcs, double distance, const Approaches::Options& options, PoolLease& lease)
      : arcs_(arcs), distance_(distance), options_(options), lease_(lease) {}

  Approaches run(double begin, double end) {
    const Steps steps = Steps::of(begin, end, chosen_step(begin, end));
    Approaches found = follow(steps, near_steps(steps));
    found.step = steps.length;
    return found;
  }

 private:
  double chosen_step(double begin, double end);
  double work_per_time(double from, double length);
  std::vector<NearSteps> near_steps(const Steps& steps);
  Approaches follow(const Steps& steps, const std::vector<NearSteps>& near);
  void report(double done) const {
    if (options_.progress) (*options_.progress)(done);
  }
  /// Calls f(begin, end, worker) for ranges of items, on several threads, and reports progress in between.
  template <class F>
  void in_parts(std::size_t items, std::size_t least, double from, double to, F f) {
    const std::size_t part = std::max(items / 100 + 1, 4 * least * lease_.count());
    for (std::size_t first = 0; first < items; first += part) {
      const std::size_t count = std::min(part, items - first);
      lease_.parallel_for(count, least, [&](std::size_t begin, std::size_t end, std::size_t worker) {
        f(first + begin, first + end, worker);
      });
      report(from + (to - from) * static_cast<double>(first + count) / static_cast<double>(items));
    }
  }

  const ArcTable& arcs_;
  double distance_;
  const Approaches::Options& options_;
  PoolLease& lease_;
};

/// Returns about the time that a search of a step takes, for each unit of time.
double Search::work_per_time(double from, double length) {
  StepSearch search(arcs_, distance_, options_);
  search.paths.compute(Steps::of(from, from + length, length), 0, 1);
  search.pairs.find(search.paths.at(0), [](std::uint32_t, std::uint32_t) {});
  return search.pairs.work() / length;
}

/// Tries steps at three times: first one in which the fastest body goes as far as the distance, or 2^-30 of
/// the whole time, then twice as long ones until the work grows.
double Search::chosen_step(double begin, double end) {
  const double whole = end - begin;
  double best = whole, least = infinity;
  for (double length = std::max(distance_ / arcs_.largest_speed(), 0x1p-30 * whole); length < whole;
       length *= 2.0) {
    double work = 0.0;
    for (const double part : {0.15, 0.45, 0.85})
      work += work_per_time(begin + part * (whole - length), length);
    if (work > 1.5 * least) break;
    if (work < least) best = length;
    least = std::min(least, work);
  }
  return best;
}

std::vector<NearSteps> Search::near_steps(const Steps& steps) {
  const std::size_t blocks = (steps.count + steps_at_once - 1) / steps_at_once;
  std::vector<StepSearch> searches(lease_.count(), StepSearch(arcs_, distance_, options_));
  std::vector<std::vector<NearSteps>> found(blocks);
  in_parts(blocks, 1, 0.0, 0.9, [&](std::size_t begin, std::size_t end, std::size_t worker) {
    StepSearch& search = searches[worker];
    for (std::size_t block = begin; block < end; ++block) {
      const std::size_t first = block * steps_at_once, last = std::min(first + steps_at_once, steps.count);
      search.paths.compute(steps, first, last);
      for (std::size_t step = first; step < last; ++step)
        search.pairs.find(search.paths.at(step - first), [&](std::uint32_t a, std::uint32_t b) {
          found[block].push_back({a, b, step, step + 1});
        });
      join(found[block]);
    }
  });
  std::vector<NearSteps> all;
  for (const auto& some : found) all.insert(all.end(), some.begin(), some.end());
  join(all);
  return all;
}

Approaches Search::follow(const Steps& steps, const std::vector<NearSteps>& near) {
  constexpr std::size_t pairs_at_once = 64;
  std::vector<PairCourse> parts(near.size() / pairs_at_once + 1, PairCourse(arcs_, distance_));
  in_parts(parts.size(), 1, 0.9, 1.0, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t part = begin; part < end; ++part)
      for (std::size_t k = part * pairs_at_once; k < std::min(near.size(), (part + 1) * pairs_at_once); ++k)
        parts[part].follow(near[k].first, near[k].second, steps.time(near[k].begin), steps.time(near[k].end));
  });
  /// An approach by its part and its number there.
  struct Place {
    const PairCourse* part;
    std::size_t number;
    const Approaches::Approach& approach() const { return part->approaches[number]; }
  };
  std::vector<Place> order;
  for (const PairCourse& part : parts)
    for (std::size_t k = 0; k < part.approaches.size(); ++k) order.push_back({&part, k});
  std::sort(order.begin(), order.end(), [](const Place& left, const Place& right) {
    const auto &a = left.approach(), &b = right.approach();
    return std::tie(a.begin, a.first, a.second, a.end) < std::tie(b.begin, b.first, b.second, b.end);
  });
  Approaches all;
  for (const Place& place : order) {
    auto of_it =
        std::lower_bound(place.part->minima.begin(), place.part->minima.end(), place.number,
                         [](const auto& minimum, std::size_t number) { return minimum.approach < number; });
    Approaches::Approach approach = place.approach();
    approach.closest += all.minima.size() - static_cast<std::size_t>(of_it - place.part->minima.begin());
    for (; of_it != place.part->minima.end() && of_it->approach == place.number; ++of_it) {
      all.minima.push_back(*of_it);
      all.minima.back().approach = all.approaches.size();
    }
    all.approaches.push_back(approach);
  }
  return all;
}

}  // namespace

Result<Approaches> Approaches::of(const PolynomialPaths& paths, double distance, const Options& options) {
  constexpr const char* call = "Approaches::of";
  PoolLease lease(options.workers);
  InputCheck check(call);
  check.positive({"distance"}, distance)
      .require(distance <= limits::largest_speed, ErrorCode::out_of_range, {"distance"}, "must be at most",
               limits::largest_speed, distance)
      .require(bool{lease}, ErrorCode::workers_busy, {"options.workers"}, "must be free",
               "busy in another call")
      .require(!options.progress || *options.progress, ErrorCode::null_callback, {"options.progress"},
               "must be a function", "empty");
  if (options.begin) check.finite({"options.begin"}, *options.begin);
  if (options.end) check.finite({"options.end"}, *options.end);
  if (options.body)
    check.require(*options.body < paths.body_count(), ErrorCode::unknown_body,
                  {"options.body", BodyId{.index = *options.body}}, "must be less than the number of bodies,",
                  paths.body_count(), *options.body);
  if (check.error()) return *check.error();
  if (const auto error = first_error(call, paths, lease)) return *error;
  if (paths.bodies.empty()) return Approaches{};
  const double begin = std::max(options.begin.value_or(-infinity),
                                *std::min_element(paths.begins.begin(), paths.begins.end()));
  const double end =
      std::min(options.end.value_or(infinity), *std::max_element(paths.ends.begin(), paths.ends.end()));
  if (!(begin < end)) return Approaches{};
  const ArcTable arcs(paths, lease);
  return Search(arcs, distance, options, lease).run(begin, end);
}

Vec3 in_orbital_frame(const State& body, const Vec3& vector) {
  const Vec3 radial = body.position / norm(body.position);
  const Vec3 normal = cross(body.position, body.velocity);
  const Vec3 cross_track = normal / norm(normal);
  return {dot(vector, radial), dot(vector, cross(cross_track, radial)), dot(vector, cross_track)};
}

}  // namespace kinesphere
