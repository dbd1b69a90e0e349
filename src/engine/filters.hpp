// Who may touch or sense whom: the filters of bodies and the caller's pair filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "engine/call_state.hpp"
#include "kinesphere/body.hpp"
#include "kinesphere/filter.hpp"

namespace kinesphere {

class Filters {
 public:
  /// False as long as all bodies may touch each other.
  bool any() const { return any_; }
  /// From now on some may not, for a reason that is not kept here: they are fixed, or not solid.
  void set_any() { any_ = true; }

  const Filter& of(std::uint32_t number) const {
    static constexpr Filter none{};
    return number < filters_.size() ? filters_[number] : none;
  }
  void keep(std::uint32_t number, const Filter& filter) {
    if (filter != Filter{}) {
      any_ = true;
      if (number >= filters_.size()) filters_.resize(number + std::size_t{1});
    }
    if (number < filters_.size()) filters_[number] = filter;
  }
  bool has_pair_filter() const { return static_cast<bool>(pair_filter_); }
  void keep_pair_filter(PairFilter filter) {
    any_ = true;
    pair_filter_ = std::move(filter);
  }
  /// Whether this thread is in the pair filter.
  bool is_filtering() const { return pair_filter_ && FilterQuestion::is_asked_by(this); }

  /// Whether they let two bodies touch or sense each other.
  bool may_meet(BodyId a, const Filter& filter_a, BodyId b, const Filter& filter_b) const {
    return passes(filter_a, filter_b) && (!pair_filter_ || ask(a, b));
  }
  bool may_touch(BodyId a, const BodyDefinition& body_a, BodyId b, const BodyDefinition& body_b) const {
    return body_a.solid && body_b.solid && may_meet(a, body_a.filter, b, body_b.filter);
  }

  /// Of one that was read.
  bool is_valid(std::size_t bodies) const { return filters_.size() <= bodies; }

 private:
  friend class Bodies;  // its serialize() archives the fields

  bool ask(BodyId a, BodyId b) const {
    const FilterQuestion question(this);
    return pair_filter_(a, b);
  }

  std::vector<Filter> filters_;  ///< of all bodies up to the last one that has another than the default
  PairFilter pair_filter_;
  bool any_ = false;
};

}  // namespace kinesphere
