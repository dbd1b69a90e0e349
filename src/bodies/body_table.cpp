#include "bodies/body_table.hpp"

#include <algorithm>
#include <atomic>

namespace kinesphere {
namespace {

std::uint32_t next_tag() {
  static std::atomic<std::uint32_t> count{0};
  const std::uint32_t tag = ++count;
  return tag == 0 ? next_tag() : tag;
}

}  // namespace

BodyTable::BodyTable() : tag_(next_tag()) {}

std::size_t BodyTable::present_count() const {
  return static_cast<std::size_t>(
      std::count_if(begin(), end(), [](const Body& body) { return body.present(); }));
}

std::uint32_t BodyTable::take() {
  std::uint32_t number = numbers();
  if (free_.empty()) {
    bodies_.emplace_back();
  } else {
    number = free_.back();
    free_.pop_back();
  }
  bodies_[number].alive = true;
  ++live_count_;
  return number;
}

std::uint32_t BodyTable::take(std::uint32_t name) {
  const std::uint32_t number = take();
  names_.resize(numbers());
  names_[number] = name;
  return number;
}

void BodyTable::give_back(std::uint32_t number) {
  Body& body = bodies_[number];
  const std::uint32_t generation = body.generation + 1;
  const std::uint32_t revision = body.revision;
  body = Body{};
  body.generation = generation;
  body.revision = revision;
  free_.push_back(number);
  --live_count_;
}

BodyId BodyTable::next_id(std::size_t additions_before) const {
  if (additions_before < free_.size()) return id_of(free_[free_.size() - 1 - additions_before]);
  return {static_cast<std::uint32_t>(bodies_.size() + (additions_before - free_.size())), 0, tag_};
}

bool BodyTable::was_given_out(BodyId id) const {
  if (id.index >= numbers()) return false;
  const Body& body = bodies_[id.index];
  return id.generation < body.generation || (id.generation == body.generation && body.alive);
}

}  // namespace kinesphere
