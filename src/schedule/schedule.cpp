// The two schedules.
#include "schedule/schedule.hpp"

#include <algorithm>
#include <cmath>

namespace kinesphere {

void LinearSchedule::set(std::uint32_t body, double time) {
  if (body >= entries_.size()) entries_.resize(body + 1);
  if (!entries_[body].present) ++size_;
  entries_[body] = {time, true};
}

void LinearSchedule::remove(std::uint32_t body) {
  if (!contains(body)) return;
  entries_[body].present = false;
  --size_;
}

Due LinearSchedule::earliest() const {
  Due first{std::numeric_limits<double>::infinity(), std::numeric_limits<std::uint32_t>::max()};
  for (std::uint32_t body = 0; body < entries_.size(); ++body)
    if (entries_[body].present) first = std::min(first, Due{entries_[body].time, body});
  return first;
}

void HeapSchedule::set(std::uint32_t body, double time) {
  if (body >= positions_.size()) positions_.resize(body + 1, absent);
  const Due due{time, body};
  if (positions_[body] == absent) {
    heap_.push_back(due);
    sift_up(heap_.size() - 1, due);
  } else if (const std::size_t position = positions_[body]; due < heap_[position]) {
    sift_up(position, due);
  } else {
    sift_down(position, due);
  }
}

void HeapSchedule::remove(std::uint32_t body) {
  if (!contains(body)) return;
  const std::size_t position = positions_[body];
  const Due removed = heap_[position];
  const Due last = heap_.back();
  heap_.pop_back();
  positions_[body] = absent;
  if (position == heap_.size()) return;
  if (last < removed) {
    sift_up(position, last);
  } else {
    sift_down(position, last);
  }
}

bool HeapSchedule::is_sound() const {
  const auto present = static_cast<std::size_t>(
      std::count_if(positions_.begin(), positions_.end(), [](std::uint32_t p) { return p != absent; }));
  if (present != heap_.size()) return false;
  for (std::size_t position = 0; position < heap_.size(); ++position) {
    const Due& due = heap_[position];
    if (std::isnan(due.time) || due.body >= positions_.size() || positions_[due.body] != position)
      return false;
    if (position > 0 && due < heap_[(position - 1) / arity]) return false;
  }
  return true;
}

void HeapSchedule::place(std::size_t position, const Due& due) {
  heap_[position] = due;
  positions_[due.body] = static_cast<std::uint32_t>(position);
}

void HeapSchedule::sift_up(std::size_t position, const Due& due) {
  while (position > 0) {
    const std::size_t parent = (position - 1) / arity;
    if (!(due < heap_[parent])) break;
    place(position, heap_[parent]);
    position = parent;
  }
  place(position, due);
}

void HeapSchedule::sift_down(std::size_t position, const Due& due) {
  for (;;) {
    const std::size_t first_child = position * arity + 1;
    if (first_child >= heap_.size()) break;
    const std::size_t end = std::min(first_child + arity, heap_.size());
    const auto child = std::min_element(heap_.begin() + static_cast<std::ptrdiff_t>(first_child),
                                        heap_.begin() + static_cast<std::ptrdiff_t>(end));
    if (!(*child < due)) break;
    const auto child_position = static_cast<std::size_t>(child - heap_.begin());
    place(position, *child);
    position = child_position;
  }
  place(position, due);
}

}  // namespace kinesphere
