// SideTable stores a property that few bodies have, without gaps. A body stores the index of its record, and
// the record the number of its body.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <vector>

#include "bodies/body.hpp"

namespace kinesphere {

template <class Record, std::uint32_t Body::*index>
class SideTable {
 public:
  bool empty() const { return records_.empty(); }
  std::size_t size() const { return records_.size(); }
  /// Returns nullptr if the body has no record.
  const Record* find(const Body& body) const {
    return body.*index == Body::none ? nullptr : &records_[body.*index];
  }
  /// Gives the body a record with default fields. Precondition: it has none.
  Record& add(Body& body, std::uint32_t number) { return give(body, number, extend(1)); }
  Record& operator[](const Body& body) { return records_[body.*index]; }
  /// Makes room for so many records at once, with default fields. Returns the index of the first. give() has
  /// to follow for each. Threads may call it for different bodies.
  std::size_t extend(std::size_t more) {
    records_.resize(records_.size() + more);
    return records_.size() - more;
  }
  Record& give(Body& body, std::uint32_t number, std::size_t place) {
    assert(body.*index == Body::none);
    body.*index = static_cast<std::uint32_t>(place);
    records_[place].body = number;
    return records_[place];
  }
  /// Removes the record of the body, if there is one. The last record takes its index. `bodies` contains the
  /// bodies of all records, by number.
  template <class Numbered>
  void remove(Numbered& bodies, std::uint32_t number) {
    const std::uint32_t gap = bodies[number].*index;
    if (gap == Body::none) return;
    bodies[records_.back().body].*index = gap;
    bodies[number].*index = Body::none;
    records_[gap] = records_.back();
    records_.pop_back();
  }

  /// Takes its record from the body; drop_released() has to follow. Threads may call it for different bodies.
  void release(Body& body) {
    records_[body.*index].body = Body::none;
    body.*index = Body::none;
  }
  /// Removes the records that bodies have released: so many. Cost: O(records), or O(1) if these are all.
  template <class Numbered>
  void drop_released(Numbered& bodies, std::size_t released) {
    if (released == records_.size()) return records_.clear();
    if (released == 0) return;
    std::uint32_t kept = 0;
    for (const Record& record : records_) {
      if (record.body == Body::none) continue;
      bodies[record.body].*index = kept;
      records_[kept++] = record;
    }
    records_.resize(kept);
  }

  /// Returns true if each record belongs to one body. Call after reading.
  template <class Numbered>
  bool is_valid(const Numbered& bodies) const {
    for (std::uint32_t record = 0; record < records_.size(); ++record) {
      const std::uint32_t number = records_[record].body;
      if (number >= bodies.numbers() || bodies[number].*index != record) return false;
    }
    return std::count_if(bodies.begin(), bodies.end(),
                         [](const Body& body) { return body.*index != Body::none; }) == std::ssize(records_);
  }
  static void serialize(auto& self, auto& archive) {
    auto& [records] = self;
    archive(records);
  }

 private:
  std::vector<Record> records_;
};

using WaitingChanges = SideTable<Change, &Body::change_number>;
using SleepRecords = SideTable<SleepRecord, &Body::sleep_number>;

}  // namespace kinesphere
