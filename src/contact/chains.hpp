// Many lists, nearly all of them empty or short, in one table.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <type_traits>
#include <vector>

namespace kinesphere {

class HeapCounter;

/// Lists 0, 1, ... of values, each in the order in which they were added. Those that were never added to are
/// empty and cost nothing; others cost 4 bytes, and a value and 4 bytes for each that was there at once. Cost
/// of a change: O(length of the list).
template <class T>
class Chains {
  struct Node;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

 public:
  class List {
   public:
    class Iterator {
     public:
      using iterator_category = std::forward_iterator_tag;
      using value_type = T;
      using difference_type = std::ptrdiff_t;
      using pointer = const T*;
      using reference = const T&;

      Iterator() = default;
      Iterator(const std::vector<Node>& nodes, std::uint32_t at) : nodes_(&nodes), at_(at) {}
      const T& operator*() const { return (*nodes_)[at_].value; }
      const T* operator->() const { return &**this; }
      Iterator& operator++() {
        at_ = (*nodes_)[at_].next;
        return *this;
      }
      Iterator operator++(int) {
        const Iterator before = *this;
        ++*this;
        return before;
      }
      friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

     private:
      const std::vector<Node>* nodes_ = nullptr;
      std::uint32_t at_ = none;
    };

    List(const std::vector<Node>& nodes, std::uint32_t first) : nodes_(&nodes), first_(first) {}
    bool empty() const { return first_ == none; }
    Iterator begin() const { return {*nodes_, first_}; }
    Iterator end() const { return {*nodes_, none}; }

   private:
    const std::vector<Node>* nodes_;
    std::uint32_t first_;
  };

  /// Good until the list changes, or another one is added to.
  List of(std::uint32_t list) const { return {nodes_, list < first_.size() ? first_[list] : none}; }
  /// All lists from this number on are empty.
  std::size_t size() const { return first_.size(); }

  void add(std::uint32_t list, const T& value) {
    if (list >= first_.size()) first_.resize(list + std::size_t{1}, none);
    std::uint32_t* link = &first_[list];
    while (*link != none) link = &nodes_[*link].next;
    if (free_ == none) {
      // The link may lie in the table that grows.
      const auto node = static_cast<std::uint32_t>(nodes_.size());
      *link = node;
      nodes_.push_back({value, none});
    } else {
      const std::uint32_t node = free_;
      free_ = nodes_[node].next;
      nodes_[node] = {value, none};
      *link = node;
    }
  }
  /// All equal to `value`.
  void erase(std::uint32_t list, const T& value) {
    erase_if(list, [&](const T& one) { return one == value; });
  }
  void clear(std::uint32_t list) {
    erase_if(list, [](const T&) { return true; });
  }

  /// Bytes hold the lists, not where they stand.
  template <class Self, class Archive>
  static void transfer(Self& self, Archive& archive) {
    if constexpr (std::same_as<Archive, HeapCounter>) {
      archive(self.first_, self.nodes_);
    } else {
      std::vector<std::vector<T>> lists(self.size());
      for (std::uint32_t list = 0; list < lists.size(); ++list)
        lists[list].assign(self.of(list).begin(), self.of(list).end());
      archive(lists);
      if constexpr (!std::is_const_v<Self>) self.build(lists);
    }
  }

 private:
  struct Node {
    T value;
    std::uint32_t next;  ///< of the list, or of the free ones
  };

  template <class Picks>
  void erase_if(std::uint32_t list, Picks picks) {
    if (list >= first_.size()) return;
    for (std::uint32_t* link = &first_[list]; *link != none;) {
      const std::uint32_t node = *link;
      if (picks(nodes_[node].value)) {
        *link = nodes_[node].next;
        nodes_[node].next = free_;
        free_ = node;
      } else {
        link = &nodes_[node].next;
      }
    }
  }
  void build(const std::vector<std::vector<T>>& lists) {
    *this = {};
    first_.resize(lists.size(), none);
    for (std::uint32_t list = 0; list < lists.size(); ++list)
      for (const T& value : lists[list]) add(list, value);
  }

  std::vector<std::uint32_t> first_;  ///< by list
  std::vector<Node> nodes_;
  std::uint32_t free_ = none;
};

}  // namespace kinesphere
