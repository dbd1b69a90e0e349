#include "window/layer.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// A capsule of nobody: nothing comes near it but what comes near everything.
constexpr Capsule hole{{0x1p55f, 0x1p55f, 0x1p55f}, {}, 0.0f};

/// Cells are to hold about as many, where they hold any.
constexpr std::size_t too_few_in_a_cell = 3;
/// So few are in one cell: a search looks at all of them.
constexpr std::size_t few = 32;
constexpr std::size_t too_many_in_a_cell = 24;

/// Whole numbers of cells stay below this, so that sums of some do not overflow.
constexpr float most_cells = 0x1p29f;

/// So many are read at a time, on processors that can.
constexpr std::uint32_t lanes = capsule_lanes;

}  // namespace

void Layer::clear(const CapsuleFrame& frame) {
  frame_ = frame;
  for (std::vector<float>& column : columns_) column.clear();
  numbers_.clear();
  cells_.clear();
  starts_.clear();
  sorted_ = 0;
  holes_ = 0;
  reach_ = 0.0f;
  widest_ = 0.0f;
  most_behind_ = least_behind;
}

CapsuleColumns Layer::columns() const {
  CapsuleColumns pointers;
  for (std::size_t k = 0; k < columns_.size(); ++k) pointers[k] = columns_[k].data();
  return pointers;
}

Capsule Layer::capsule_at(std::uint32_t place) const {
  const auto& [x, y, z, u, v, w, r] = columns_;
  return {{x[place], y[place], z[place]}, {u[place], v[place], w[place]}, r[place]};
}

void Layer::store(std::uint32_t place, const Capsule& capsule) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    columns_[axis][place] = capsule.centre[axis];
    columns_[axis + 3][place] = capsule.velocity[axis];
  }
  columns_[6][place] = capsule.radius;
}

std::uint32_t Layer::add(std::uint32_t number, const Capsule& capsule, float from) {
  const auto place = static_cast<std::uint32_t>(numbers_.size());
  for (std::vector<float>& column : columns_) {
    if (column.size() < place + capsule_lanes + 1) column.resize(place + capsule_lanes + 1);
  }
  numbers_.push_back(number);
  store(place, capsule);
  widest_ = std::max(widest_, width_of(corners_of(capsule, from, 1.0f)));
  return place;
}

std::optional<float> Layer::overhang_at(std::uint32_t place, const Capsule& capsule, float from) const {
  assert(numbers_[place] != nobody);
  // Those that were added later have no cell.
  if (place >= sorted_) return 0.0f;
  const Corners corners = corners_of(capsule, from, 1.0f);
  const float out = overhang(nearest_image(cells_[place], grid_.cell_around(corners)), corners);
  return out <= grid_.edge[1] ? std::optional(out) : std::nullopt;
}

void Layer::replace(std::uint32_t place, const Capsule& capsule, float from, float overhang, Growth& growth) {
  assert(numbers_[place] != nobody);
  growth.reach = std::max(growth.reach, overhang);
  growth.widest = std::max(growth.widest, width_of(corners_of(capsule, from, 1.0f)));
  ++growth.replaced;
  store(place, capsule);
}

void Layer::remove(std::uint32_t place) {
  assert(numbers_[place] != nobody);
  numbers_[place] = nobody;
  ++holes_;
  store(place, hole);
}

Layer::Corners Layer::corners_of(const Capsule& capsule, float from, float to) {
  Corners corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float first = capsule.centre[axis] + capsule.velocity[axis] * from;
    const float last = capsule.centre[axis] + capsule.velocity[axis] * to;
    corners.lower[axis] = std::min(first, last) - capsule.radius;
    corners.upper[axis] = std::max(first, last) + capsule.radius;
  }
  return corners;
}

/// Infinite for what is not a number.
float Layer::width_of(const Corners& corners) {
  float widest = 0.0f;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float width = corners.upper[axis] - corners.lower[axis];
    if (!(width <= widest)) widest = width;
  }
  return widest < infinity ? widest : std::numeric_limits<float>::infinity();
}

std::int32_t Layer::Grid::cell_of(float coordinate, std::size_t axis) const {
  const float cells = coordinate * per_edge[axis];
  const float within = !(cells > -most_cells) ? -most_cells : cells < most_cells ? cells : most_cells;
  const auto cut = static_cast<std::int32_t>(within);
  return cut - (within < static_cast<float>(cut) ? 1 : 0);
}

std::int32_t Layer::Grid::wrapped(std::int32_t cell, std::size_t axis) const {
  const std::int32_t way = cell - first[axis];
  if (0 <= way && way < count[axis]) return way;
  const std::int32_t rest = way % count[axis];
  return rest < 0 ? rest + count[axis] : rest;
}

/// Of their middle.
Layer::Cell Layer::Grid::cell_around(const Corners& corners) const {
  Cell cell;
  for (std::size_t axis = 0; axis < 3; ++axis)
    cell[axis] = cell_of(0.5f * (corners.lower[axis] + corners.upper[axis]), axis);
  return cell;
}

std::uint32_t Layer::Grid::index_of(const Cell& cell) const {
  std::uint32_t index = 0;
  for (std::size_t axis = 3; axis-- > 0;)
    index = index * static_cast<std::uint32_t>(count[axis]) +
            static_cast<std::uint32_t>(wrapped(cell[axis], axis));
  return index;
}

Layer::Cell Layer::Grid::cell_at(std::uint32_t index) const {
  Cell cell;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<std::uint32_t>(count[axis]);
    cell[axis] = static_cast<std::int32_t>(index % along);
    index /= along;
  }
  return cell;
}

bool Layer::Grid::is_sound() const {
  constexpr auto most = static_cast<std::int32_t>(most_cells);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float size = edge[axis];
    if (!(size > 0.0f && size < std::numeric_limits<float>::infinity() && per_edge[axis] == 1.0f / size) ||
        first[axis] < -most || first[axis] > most)
      return false;
  }
  return true;
}

/// This cell or, of those that share capsules with it, the one that is nearest to another.
Layer::Cell Layer::nearest_image(std::uint32_t cell, const Cell& of) const {
  Cell image = grid_.cell_at(cell);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!grid_.folded[axis]) {
      image[axis] += grid_.first[axis];
      continue;
    }
    const std::int32_t count = grid_.count[axis];
    std::int32_t way = image[axis] - grid_.wrapped(of[axis], axis);
    if (2 * way > count) way -= count;
    if (2 * way < -count) way += count;
    image[axis] = of[axis] + way;
  }
  return image;
}

/// How far corners reach out of a cell; a little more, as what is added to it or taken from it may be lost in
/// rounding.
float Layer::overhang(const Cell& cell, const Corners& corners) const {
  float most = 0.0f;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto here = static_cast<float>(cell[axis]);
    const float below = here * grid_.edge[axis] - corners.lower[axis];
    const float above = corners.upper[axis] - (here + 1.0f) * grid_.edge[axis];
    // What is not a number reaches everywhere.
    for (const float out : {below, above})
      if (!(out <= most)) most = out;
  }
  return most < infinity ? most * (1.0f + 0x1p-20f) : std::numeric_limits<float>::infinity();
}

Layer::Corners Layer::corners_at(std::uint32_t place) const {
  return corners_of(capsule_at(place), 0.0f, 1.0f);
}

/// Where the middles of all capsules are, and how wide the widest is; but for those that are too large for
/// whole numbers of cells.
struct Layer::Spread {
  Point lower{most_cells, most_cells, most_cells};
  Point upper{-most_cells, -most_cells, -most_cells};
  float widest = 0.0f;
  float extent = 0.0f;   ///< of the box around the middles, but no less than the widest
  float largest = 0.0f;  ///< the widest without that limit
  bool outside = false;  ///< the middle of one of those that are too large may be

  void add(const Corners& corners) {
    largest = std::max(largest, width_of(corners));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float middle = 0.5f * (corners.lower[axis] + corners.upper[axis]);
      if (!(std::abs(middle) < most_cells)) {
        outside = true;
        continue;
      }
      lower[axis] = std::min(lower[axis], middle);
      upper[axis] = std::max(upper[axis], middle);
      const float width = corners.upper[axis] - corners.lower[axis];
      if (width < most_cells) widest = std::max(widest, width);
    }
  }
  void add(const Spread& more) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], more.lower[axis]);
      upper[axis] = std::max(upper[axis], more.upper[axis]);
    }
    widest = std::max(widest, more.widest);
    largest = std::max(largest, more.largest);
    outside = outside || more.outside;
  }
};

Layer::Spread Layer::spread_of(const Unsorted& all, Shift& shift) {
  std::vector<Spread> spreads(shift.count());
  shift.for_each(all.capsules.size(), many, [&](std::size_t begin, std::size_t end, std::size_t worker) {
    Spread spread;
    for (std::size_t k = begin; k < end; ++k) spread.add(corners_of(all.capsules[k], 0.0f, 1.0f));
    spreads[worker].add(spread);
  });
  Spread spread;
  for (const Spread& one : spreads) spread.add(one);
  spread.extent = spread.widest;
  for (std::size_t axis = 0; axis < 3; ++axis)
    spread.extent = std::max(spread.extent, spread.upper[axis] - spread.lower[axis]);
  return spread;
}

/// Cells as wide as the largest capsule, times the coarseness, over the box that holds all centres; fewer,
/// which then stand for several places each, if there would be more cells than capsules.
void Layer::choose_grid(const Spread& spread, std::size_t size) {
  const Point& lower = spread.lower;
  const float edge = std::max(size > few ? coarseness_ * spread.widest : 4.0f * spread.extent, 0x1p-20f);
  grid_.edge = {edge / Grid::slices, edge, edge};
  for (std::size_t axis = 0; axis < 3; ++axis) grid_.per_edge[axis] = 1.0f / grid_.edge[axis];
  grid_.folded = {spread.outside, spread.outside, spread.outside};
  if (size <= few) {
    grid_.first = {};
    grid_.count = {1, 1, 1};
    grid_.folded = {true, true, true};
    return;
  }
  std::size_t cells = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    grid_.first[axis] = grid_.cell_of(lower[axis], axis);
    const std::int32_t last = grid_.cell_of(std::max(lower[axis], spread.upper[axis]), axis);
    const std::int32_t all = last - grid_.first[axis] + 1;
    grid_.count[axis] = std::min(all, 1 << 20);
    if (grid_.count[axis] < all) grid_.folded[axis] = true;
    cells *= static_cast<std::size_t>(grid_.count[axis]);
  }
  while (cells > 8 * size) {
    const auto most = std::max_element(grid_.count.begin(), grid_.count.end());
    cells /= static_cast<std::size_t>(*most);
    *most = (*most + 1) / 2;
    cells *= static_cast<std::size_t>(*most);
    grid_.folded[static_cast<std::size_t>(most - grid_.count.begin())] = true;
  }
}

/// Of cells that have been counted: starts_[cell] has how many are in it.
std::uint32_t Layer::filled_cubes(Shift& shift) const {
  const auto along = static_cast<std::size_t>(grid_.count[0]);
  const std::size_t rows = cell_count() / along;
  std::atomic<std::uint32_t> all = 0;
  shift.for_each(rows, many / along + 1, [&](std::size_t from, std::size_t to, std::size_t) {
    std::uint32_t filled = 0;
    for (std::size_t row = from * along; row < to * along; row += along) {
      for (std::size_t first = 0; first < along; first += Grid::slices) {
        const auto begin = starts_.begin() + static_cast<std::ptrdiff_t>(row + first);
        const auto end =
            begin + static_cast<std::ptrdiff_t>(std::min<std::size_t>(Grid::slices, along - first));
        filled += std::any_of(begin, end, [](std::uint32_t count) { return count > 0; }) ? 1 : 0;
      }
    }
    all += filled;
  });
  return all;
}

double Layer::density(bool flat) const {
  if (filled_ == 0) return 0.0;
  const double edge = grid_.edge[1];
  return sorted_ / (filled_ * (flat ? edge * edge : edge * edge * edge));
}

/// Counts how many are in each cell, starts_[cell], tells in which cell each is, and finds out how far they
/// stick out of them.
void Layer::count_by_cells(const Unsorted& all, std::vector<std::uint32_t>& cells, Shift& shift) {
  std::vector<float> reaches(shift.count());
  shift.for_each(all.capsules.size(), many, [&](std::size_t begin, std::size_t end, std::size_t worker) {
    float reach = 0.0f;
    for (std::size_t k = begin; k < end; ++k) {
      const Corners corners = corners_of(all.capsules[k], 0.0f, 1.0f);
      const Cell cell = grid_.cell_around(corners);
      cells[k] = grid_.index_of(cell);
      reach = std::max(reach, overhang(cell, corners));
    }
    reaches[worker] = std::max(reaches[worker], reach);
  });
  reach_ = *std::max_element(reaches.begin(), reaches.end());
  // Growing alone would make room for twice as many.
  starts_.reserve(cell_count() + 1);
  starts_.resize(cell_count() + 1);
  starts_.back() = 0;
  for_each_range(cells.size(), shift, [&](std::uint32_t from, std::uint32_t to) {
    std::fill(starts_.begin() + from, starts_.begin() + to, 0);
    for (const std::uint32_t cell : cells)
      if (cell - from < to - from) ++starts_[cell];
  });
}

/// Calls visit(from, to) for ranges of cells that together are all, one for each of some threads if there are
/// many capsules: each of them goes through all of these.
template <class Visit>
void Layer::for_each_range(std::size_t capsules, Shift& shift, Visit visit) const {
  const std::size_t cells = cell_count();
  constexpr std::size_t most_ranges = 8;
  const std::size_t ranges = capsules < many ? 1 : std::min(shift.count(), most_ranges);
  shift.for_each(ranges, 1, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k)
      visit(static_cast<std::uint32_t>(cells * k / ranges),
            static_cast<std::uint32_t>(cells * (k + 1) / ranges));
  });
}

/// Gives each its place among those of its cell, in the order in which they stand, in the cells that have
/// been counted.
void Layer::choose_places(const std::vector<std::uint32_t>& cells, std::vector<std::uint32_t>& places,
                          Shift& shift) {
  // Cells tell of the ends of their parts first, and of their begins when the last one has been taken from
  // there.
  std::uint32_t sum = 0;
  for (std::uint32_t& start : starts_) start = sum += start;
  for_each_range(cells.size(), shift, [&](std::uint32_t from, std::uint32_t to) {
    for (std::size_t k = cells.size(); k-- > 0;)
      if (cells[k] - from < to - from) places[k] = --starts_[cells[k]];
  });
}

Layer::Unsorted Layer::without_holes() const {
  Unsorted all(size());
  std::size_t next = 0;
  for (std::uint32_t place = 0; place < numbers_.size(); ++place) {
    if (numbers_[place] == nobody) continue;
    all.numbers[next] = numbers_[place];
    all.capsules[next++] = capsule_at(place);
  }
  return all;
}

/// Returns how wide the widest is.
float Layer::arrange(const Unsorted& all, Shift& shift) {
  const auto count = static_cast<std::uint32_t>(all.numbers.size());
  std::vector<std::uint32_t> cells(count);
  const Spread spread = spread_of(all, shift);
  // Larger ones would be of no use.
  const auto is_of_use = [&spread](float coarseness) {
    return coarseness == 1.0f || coarseness * spread.widest <= 4.0f * spread.extent;
  };
  while (!is_of_use(coarseness_)) coarseness_ *= 0.5f;
  for (;;) {
    choose_grid(spread, count);
    count_by_cells(all, cells, shift);
    filled_ = filled_cubes(shift);
    const bool few_in_cells = cell_count() > 1 && count < too_few_in_a_cell * filled_;
    if (!(few_in_cells && coarseness_ < coarsest && is_of_use(2.0f * coarseness_))) break;
    coarseness_ *= 2.0f;
  }
  if (count > std::size_t{too_many_in_a_cell} * filled_ && coarseness_ > 1.0f) coarseness_ *= 0.5f;

  std::vector<std::uint32_t> places(count);
  choose_places(cells, places, shift);
  most_behind_ = least_behind + static_cast<std::uint32_t>(4.0 * std::sqrt(static_cast<double>(count)));
  // With room for those that come behind, or one of them would make vectors twice as large.
  for (std::vector<float>& column : columns_) {
    column.reserve(count + most_behind_ + capsule_lanes + 2);
    column.resize(count + capsule_lanes);
  }
  numbers_.reserve(count + most_behind_ + 2);
  numbers_.resize(count);
  cells_.resize(count);
  shift.for_each(count, many, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t k = begin; k < end; ++k) {
      store(places[k], all.capsules[k]);
      numbers_[places[k]] = all.numbers[k];
      cells_[places[k]] = cells[k];
    }
  });
  sorted_ = count;
  holes_ = 0;
  return spread.largest;
}

/// A query, and the rows of cells that may hold a capsule which meets its own, but for those before this cell
/// and this place in it.
void Layer::add_runs(const CapsuleQuery& query, std::uint32_t first_cell, std::uint32_t first_place,
                     Searches& searches) const {
  const auto number = static_cast<std::uint32_t>(searches.queries.size());
  std::vector<Run>& runs = searches.runs;
  searches.queries.push_back(query);
  const Corners corners = corners_of(query.capsule, query.from, query.to);
  Cell begin, count;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int32_t all = grid_.count[axis];
    const std::int32_t first = grid_.cell_of(corners.lower[axis] - reach_, axis);
    const std::int32_t last = grid_.cell_of(corners.upper[axis] + reach_, axis);
    const float cells = (corners.upper[axis] - corners.lower[axis] + 2.0f * reach_) * grid_.per_edge[axis];
    // Also where a corner is infinite or not a number.
    if (!(cells < most_cells)) {
      begin[axis] = 0;
      count[axis] = all;
    } else if (grid_.folded[axis]) {
      count[axis] = std::min(last - first + 1, all);
      begin[axis] = count[axis] == all ? 0 : grid_.wrapped(first, axis);
    } else {
      begin[axis] = std::max(first - grid_.first[axis], 0);
      count[axis] = std::min(last - grid_.first[axis] + 1, all) - begin[axis];
    }
    if (count[axis] <= 0) return;
  }
  const auto along = [this](std::size_t axis) { return static_cast<std::uint32_t>(grid_.count[axis]); };
  const auto from = [&begin](std::size_t axis) { return static_cast<std::uint32_t>(begin[axis]); };
  const auto wide = [&count](std::size_t axis) { return static_cast<std::uint32_t>(count[axis]); };
  const auto wraps = [&](std::size_t axis) { return from(axis) + wide(axis) > along(axis); };
  // Two that take no fewer vectors than both with all between them are read as one; unless what is between
  // them may have been read already.
  const bool in_order = !wraps(0) && !wraps(1) && !wraps(2);
  const auto vectors = [](const Run& run) { return (run.end - run.begin + lanes - 1) / lanes; };
  const auto add = [&](std::uint32_t first, std::uint32_t last) {
    const Run run{std::max(first, first_place), last, number};
    if (run.begin >= run.end) return;
    if (in_order && !runs.empty() && runs.back().query == number) {
      const Run both{runs.back().begin, run.end, number};
      if (vectors(both) <= vectors(runs.back()) + vectors(run)) {
        runs.back() = both;
        return;
      }
    }
    runs.push_back(run);
  };
  const std::uint32_t within = std::min(wide(0), along(0) - from(0));
  for (std::uint32_t k = from(2); k < from(2) + wide(2); ++k) {
    const std::uint32_t z = k < along(2) ? k : k - along(2);
    for (std::uint32_t j = from(1); j < from(1) + wide(1); ++j) {
      const std::uint32_t y = j < along(1) ? j : j - along(1);
      const std::uint32_t row = (z * along(1) + y) * along(0);
      if (row + along(0) <= first_cell) continue;
      add(starts_[row + from(0)], starts_[row + from(0) + within]);
      if (within < wide(0)) add(starts_[row], starts_[row + wide(0) - within]);
    }
  }
}

void Layer::add_search(const CapsuleQuery& query, Searches& searches) const {
  if (sorted_ > 0) {
    add_runs(query, 0, 0, searches);
  } else {
    searches.queries.push_back(query);
  }
  if (numbers_.size() > sorted_)
    searches.runs.push_back({sorted_, static_cast<std::uint32_t>(numbers_.size()),
                             static_cast<std::uint32_t>(searches.queries.size() - 1)});
}

void Layer::add_search_behind(std::uint32_t place, Searches& searches) const {
  assert(sorted_ == numbers_.size());
  add_runs({capsule_at(place), 0.0f, 1.0f}, cells_[place], place + 1, searches);
}

void Layer::make(Searches& searches) const {
  std::size_t words = 0;
  for (const Run& run : searches.runs) words += words_for(run);
  if (searches.words.size() < words) searches.words.resize(words);
  near_capsules(columns(), searches.queries, searches.runs, searches.words.data());
}

bool Layer::is_sound() const {
  const auto is_power = [](double value) { return value > 0.0 && value < infinity; };
  if (!is_finite(frame_.base) || !std::isfinite(frame_.origin) || !is_power(frame_.per_length) ||
      !is_power(frame_.per_time))
    return false;
  const std::size_t filled = numbers_.empty() ? 0 : numbers_.size() + capsule_lanes;
  for (const std::vector<float>& column : columns_)
    if (column.size() < filled) return false;
  const auto holes = static_cast<std::size_t>(std::count(numbers_.begin(), numbers_.end(), nobody));
  if (holes != holes_ || sorted_ > numbers_.size()) return false;
  if (!(reach_ >= 0.0f && widest_ >= 0.0f && coarseness_ >= 1.0f && coarseness_ <= coarsest)) return false;
  if (sorted_ == 0) return true;
  std::size_t cells = 1;
  for (const std::int32_t count : grid_.count) {
    if (count < 1 || count > 1 << 20) return false;
    cells *= static_cast<std::size_t>(count);
    if (cells >= starts_.size()) return false;
  }
  if (starts_.size() != cells + 1) return false;
  if (cells_.size() < sorted_) return false;
  for (std::uint32_t place = 0; place < sorted_; ++place)
    if (cells_[place] >= cells || place < starts_[cells_[place]] || place >= starts_[cells_[place] + 1])
      return false;
  return starts_.front() == 0 && starts_.back() == sorted_ &&
         std::is_sorted(starts_.begin(), starts_.end()) && grid_.is_sound() && reach_ >= 0.0f &&
         widest_ >= 0.0f && coarseness_ >= 1.0f && coarseness_ <= coarsest;
}

std::size_t Layer::bytes() const {
  std::size_t all = (numbers_.capacity() + cells_.capacity() + starts_.capacity()) * sizeof(std::uint32_t);
  for (const std::vector<float>& column : columns_) all += column.capacity() * sizeof(float);
  return all;
}

}  // namespace kinesphere
