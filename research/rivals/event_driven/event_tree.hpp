// The event tree: all candidate events of all kinds in one balanced search tree (paper, section 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace kinesphere {

/// In the order in which candidates of one instant are handled: a reset renews all others of its body.
enum class CandidateKind : std::uint8_t { resetting, entering, leaving, colliding };

/// Something that will happen if nothing changes its course before.
struct Candidate {
  double time;
  CandidateKind kind;
  std::uint32_t first;
  std::uint32_t second;   ///< the other, larger number of a pair, else `first` again: it collides with a wall
  std::uint8_t face = 0;  ///< of entering and leaving: 2 axis, + 1 for the upper side

  bool concerns_pair() const { return first != second; }
  friend bool operator==(const Candidate&, const Candidate&) = default;
  /// By time, kind and bodies, so that the order never depends on history.
  friend bool operator<(const Candidate& a, const Candidate& b) {
    if (a.time != b.time) return a.time < b.time;
    return std::tie(a.kind, a.first, a.second, a.face) < std::tie(b.kind, b.first, b.second, b.face);
  }
};

class EventTree {
 public:
  /// Bodies are numbered below this.
  void resize(std::size_t bodies) { by_body_.resize(bodies); }

  /// No equal candidate may be there. Cost: O(log n).
  void insert(const Candidate& candidate);
  bool empty() const { return tree_.empty(); }
  /// Needs a tree that is not empty. Cost: O(1).
  const Candidate& earliest() const { return tree_.begin()->first; }
  /// Removes the earliest and returns it.
  Candidate pop();

  /// Removes those candidates of the body for which unwanted(candidate) holds; a pair's belongs to both.
  /// Cost: the number of its candidates, and O(log n) for each that is removed.
  template <class Unwanted>
  void remove_if(std::uint32_t body, Unwanted unwanted);
  void remove_all(std::uint32_t body) {
    remove_if(body, [](const Candidate&) { return true; });
  }

  /// Calls visit(candidate) for each candidate of the body, in no particular order.
  template <class Visit>
  void for_each(std::uint32_t body, Visit visit) const {
    for (const auto& entry : by_body_[body]) visit(entry->first);
  }

  std::size_t size() const { return tree_.size(); }
  std::size_t largest_size() const { return largest_size_; }
  std::uint64_t insertions() const { return insertions_; }
  /// Of candidates that did not come to pass.
  std::uint64_t removals() const { return removals_; }

 private:
  /// Where the candidate stands in the lists of its first and second body.
  using Places = std::array<std::uint32_t, 2>;
  using Tree = std::map<Candidate, Places>;

  void take_out(Tree::iterator entry);
  void unlist(std::uint32_t body, std::uint32_t place);

  Tree tree_;
  std::vector<std::vector<Tree::iterator>> by_body_;
  std::vector<Tree::node_type> spare_;  ///< kept for their memory
  std::size_t largest_size_ = 0;
  std::uint64_t insertions_ = 0;
  std::uint64_t removals_ = 0;
};

template <class Unwanted>
void EventTree::remove_if(std::uint32_t body, Unwanted unwanted) {
  const auto& entries = by_body_[body];
  // From the end: taking one out moves the last one, which has been looked at, into its place.
  for (std::size_t k = entries.size(); k-- > 0;) {
    if (!unwanted(entries[k]->first)) continue;
    take_out(entries[k]);
    ++removals_;
  }
}

}  // namespace kinesphere
