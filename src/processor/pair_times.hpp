// PairTimes remembers until when nothing happens between two bodies that are near each other, so that they
// are not looked at again, or asked for reports, before that.
//
// A time holds as long as the revisions of both bodies are the same (Body::revision) and their contact does
// not change. A body alone stands for it and the walls.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bodies/bodies.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

class PairTimes {
 public:
  /// Returns the time of a pair, or -infinity if none is known.
  double find(const Bodies& bodies, std::uint32_t a, std::uint32_t b) const {
    if (count_ == 0) return -infinity;
    const Entry& entry = table_[place_of(name_of(a, b))];
    return entry.is_of(bodies, name_of(a, b)) ? entry.until : -infinity;
  }
  void keep(const Bodies& bodies, std::uint32_t a, std::uint32_t b, double until, double now) {
    if (2 * (count_ + 1) > table_.size()) tidy(bodies, now);
    Entry& entry = table_[place_of(name_of(a, b))];
    if (entry.pair == nothing) ++count_;
    entry = entry_of(bodies, name_of(a, b), until);
  }
  void forget(std::uint32_t a, std::uint32_t b) {
    if (count_ > 0) table_[place_of(name_of(a, b))].until = -infinity;
  }

  /// Calls visit(a, b, until) for each pair, in no order.
  void for_each(const Bodies& bodies, auto visit) const {
    for (const Entry& entry : table_)
      if (entry.pair != nothing && entry.is_of(bodies, entry.pair))
        visit(entry.first(), entry.second(), entry.until);
  }

  static void serialize(auto& self, auto& archive) { archive(self.table_, self.count_); }
  /// Validates what was read from bytes.
  bool is_valid(std::size_t bodies) const {
    const auto is_entry = [=](const Entry& entry) {
      return (entry.pair == nothing && entry.until == -infinity) ||
             (entry.first() < bodies && entry.second() < bodies && !std::isnan(entry.until));
    };
    const auto taken = static_cast<std::size_t>(std::count_if(
        table_.begin(), table_.end(), [](const Entry& entry) { return entry.pair != nothing; }));
    return (table_.empty() || std::has_single_bit(table_.size())) && 2 * taken <= table_.size() &&
           taken == count_ && std::all_of(table_.begin(), table_.end(), is_entry);
  }
  std::size_t bytes() const { return table_.capacity() * sizeof(Entry); }

 private:
  static constexpr std::uint64_t nothing = ~std::uint64_t{0};
  struct Entry {
    std::uint64_t pair = nothing;
    double until = -infinity;
    std::uint32_t first_revision = 0, second_revision = 0;

    std::uint32_t first() const { return static_cast<std::uint32_t>(pair >> 32); }
    std::uint32_t second() const { return static_cast<std::uint32_t>(pair); }
    bool is_of(const Bodies& bodies, std::uint64_t name) const {
      return pair == name && bodies[first()].revision == first_revision &&
             bodies[second()].revision == second_revision;
    }
    static void serialize(auto& self, auto& archive) {
      archive(self.pair, self.until, self.first_revision, self.second_revision);
    }
  };

  static std::uint64_t name_of(std::uint32_t a, std::uint32_t b) {
    return static_cast<std::uint64_t>(std::min(a, b)) << 32 | std::max(a, b);
  }
  static Entry entry_of(const Bodies& bodies, std::uint64_t name, double until) {
    Entry entry{name, until};
    entry.first_revision = bodies[entry.first()].revision;
    entry.second_revision = bodies[entry.second()].revision;
    return entry;
  }
  /// Returns where a pair is, or where it would be entered. The highest bits of the product depend on both
  /// bodies, so all pairs of one body are spread, too.
  std::size_t place_of(std::uint64_t name) const {
    const std::size_t mask = table_.size() - 1;
    const std::uint64_t highest = name * 0x9E3779B97F4A7C15u >> (64 - std::countr_zero(table_.size()));
    auto place = static_cast<std::size_t>(highest);
    while (table_[place].pair != name && table_[place].pair != nothing) place = (place + 1) & mask;
    return place;
  }
  /// Drops what no longer holds, and makes room.
  void tidy(const Bodies& bodies, double now) {
    std::vector<Entry> kept;
    for (const Entry& entry : table_)
      if (entry.until > now && entry.is_of(bodies, entry.pair)) kept.push_back(entry);
    table_.assign(std::bit_ceil(4 * kept.size() + 64), Entry());
    count_ = kept.size();
    for (const Entry& entry : kept) table_[place_of(entry.pair)] = entry;
  }

  std::vector<Entry> table_;  ///< open addressing; its length is a power of two
  std::size_t count_ = 0;     ///< places that are taken
};

}  // namespace kinesphere
