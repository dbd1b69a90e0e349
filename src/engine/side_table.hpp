// SideTable stores a property that few bodies have, without gaps. A body stores the index of its record, and
// the record the number of its body.
#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "engine/body.hpp"

namespace kinesphere {

template <class Record, std::uint32_t Body::*place>
class SideTable {
 public:
  bool empty() const { return records_.empty(); }
  /// Returns nullptr if the body has no record.
  const Record* find(const Body& body) const {
    return body.*place == Body::none ? nullptr : &records_[body.*place];
  }
  /// Precondition: the body has no record.
  Record& add(Body& body, const Record& record) {
    body.*place = static_cast<std::uint32_t>(records_.size());
    return records_.emplace_back(record);
  }
  Record& operator[](const Body& body) { return records_[body.*place]; }
  /// Removes the record of the body, if there is one. The last record takes its index. `bodies` contains the
  /// bodies of all records, by number.
  template <class Numbered>
  void remove(Numbered& bodies, std::uint32_t number) {
    const std::uint32_t gap = bodies[number].*place;
    if (gap == Body::none) return;
    bodies[records_.back().body].*place = gap;
    bodies[number].*place = Body::none;
    records_[gap] = records_.back();
    records_.pop_back();
  }

  /// Returns true if each record belongs to one body. Call after reading.
  template <class Numbered>
  bool is_valid(const Numbered& bodies) const {
    for (std::uint32_t record = 0; record < records_.size(); ++record) {
      const std::uint32_t number = records_[record].body;
      if (number >= bodies.numbers() || bodies[number].*place != record) return false;
    }
    return std::count_if(bodies.begin(), bodies.end(),
                         [](const Body& body) { return body.*place != Body::none; }) == std::ssize(records_);
  }
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [records] = self;
    archive(records);
  }

 private:
  std::vector<Record> records_;
};

using WaitingChanges = SideTable<Change, &Body::change_number>;
using SleepRecords = SideTable<SleepRecord, &Body::sleep_number>;

}  // namespace kinesphere
