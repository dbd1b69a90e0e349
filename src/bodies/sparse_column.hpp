// SparseColumn stores a property of bodies by their numbers, of which most have the usual value.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace kinesphere {

template <class Value>
class SparseColumn {
 public:
  /// `usual` is the value of all bodies but those of keep().
  explicit SparseColumn(const Value& usual = Value{}) : usual_(usual) {}

  /// Returns true as long as all values have been the usual one.
  bool empty() const { return values_.empty(); }
  const Value& of(std::uint32_t number) const { return number < values_.size() ? values_[number] : usual_; }
  void keep(std::uint32_t number, const Value& value) {
    if (number >= values_.size() && !(value == usual_)) values_.resize(number + std::size_t{1}, usual_);
    if (number < values_.size()) values_[number] = value;
  }

  /// Validates the column after reading, except for the values themselves.
  bool is_valid(std::size_t bodies) const { return values_.size() <= bodies; }
  static void serialize(auto& self, auto& archive) { archive(self.values_); }

 private:
  Value usual_;
  std::vector<Value> values_;  ///< up to the last body whose value has not always been the usual one
};

}  // namespace kinesphere
