// Filters decides which bodies may touch or sense each other, from the filters of bodies and the caller's
// pair filter.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>

#include "bodies/call_state.hpp"
#include "bodies/sparse_column.hpp"
#include "kinesphere/body.hpp"
#include "kinesphere/filter.hpp"

namespace kinesphere {

class Filters {
 public:
  /// Returns false as long as all bodies may touch each other.
  bool any() const { return any_; }
  /// Makes any() true, for a restriction that is stored elsewhere: static bodies, or bodies that are not
  /// solid.
  void set_any() { any_ = true; }

  const Filter& of(std::uint32_t number) const { return filters_.of(number); }
  void keep(std::uint32_t number, const Filter& filter) {
    any_ = any_ || filter != Filter{};
    filters_.keep(number, filter);
  }
  bool has_pair_filter() const { return static_cast<bool>(pair_filter_); }
  void keep_pair_filter(PairFilter filter) {
    any_ = true;
    pair_filter_ = std::move(filter);
  }
  /// Returns true if this thread is inside the pair filter.
  bool is_filtering() const { return pair_filter_ && FilterQuestion::is_asked_by(this); }

  /// Returns true if both filters and the pair filter allow the bodies to touch or sense each other.
  bool may_meet(BodyId a, const Filter& filter_a, BodyId b, const Filter& filter_b) const {
    return passes(filter_a, filter_b) && (!pair_filter_ || ask(a, b));
  }
  bool may_touch(BodyId a, const BodyDefinition& body_a, BodyId b, const BodyDefinition& body_b) const {
    return body_a.solid && body_b.solid && may_meet(a, body_a.filter, b, body_b.filter);
  }

  /// Validates the filters after reading.
  bool is_valid(std::size_t bodies) const { return filters_.is_valid(bodies); }

 private:
  friend class Bodies;  // Bodies::serialize() archives the fields

  /// An exception of the pair filter would leave a search half done, and contacts unseen: it ends the
  /// program.
  bool ask(BodyId a, BodyId b) const noexcept {
    const FilterQuestion question(this);
    return pair_filter_(a, b);
  }

  SparseColumn<Filter> filters_;
  PairFilter pair_filter_;
  bool any_ = false;
};

}  // namespace kinesphere
