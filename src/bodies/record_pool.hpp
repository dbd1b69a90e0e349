// RecordPool stores what few bodies have; Body::shape_number is the index of a body's record. A body has a
// record of one pool at most.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bodies/body_table.hpp"

namespace kinesphere {

template <class Record>
class RecordPool {
 public:
  /// Returns true if there has never been a record.
  bool empty() const { return records_.empty(); }
  /// Returns true if there is a record now.
  bool any() const { return records_.size() > free_.size(); }

  const Record& operator[](const Body& body) const { return records_[body.shape_number]; }
  Record& operator[](const Body& body) { return records_[body.shape_number]; }

  void add(Body& body, Record record) {
    if (free_.empty()) {
      body.shape_number = static_cast<std::uint32_t>(records_.size());
      records_.push_back(std::move(record));
    } else {
      body.shape_number = free_.back();
      free_.pop_back();
      records_[body.shape_number] = std::move(record);
    }
  }
  /// Frees the record of a body that is being removed.
  void remove(const Body& body) { free_.push_back(body.shape_number); }

  /// Returns true if each record is free or belongs to one living body, one for which has_record(body) is
  /// true, and all these have one. Call after reading.
  template <class HasRecord>
  bool is_valid(const BodyTable& bodies, HasRecord has_record) const {
    std::vector<bool> is_taken(records_.size(), false);
    std::size_t taken = 0;
    const auto take = [&](std::uint32_t number) {
      if (number >= is_taken.size() || is_taken[number]) return false;
      is_taken[number] = true;
      ++taken;
      return true;
    };
    for (const std::uint32_t number : free_)
      if (!take(number)) return false;
    for (const Body& body : bodies)
      if (has_record(body) && !(body.alive && take(body.shape_number))) return false;
    return taken == records_.size();
  }

  static void serialize(auto& self, auto& archive) { archive(self.records_, self.free_); }

 private:
  std::vector<Record> records_;
  std::vector<std::uint32_t> free_;
};

}  // namespace kinesphere
