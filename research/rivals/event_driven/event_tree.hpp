// The event tree: all candidate events of all kinds in one balanced search tree (paper, section 3.2).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace kinesphere {

/// Kinds in the order in which candidates of one instant are handled: a reset renews all others of its body.
enum class CandidateKind : std::uint8_t { resetting, entering, leaving, colliding };

/// An event that will happen unless a course changes before.
struct Candidate {
  double time;
  CandidateKind kind;
  std::uint32_t first;
  std::uint32_t second;   ///< the larger number of a pair; `first` again for a wall
  std::uint8_t face = 0;  ///< for entering and leaving: 2 axis, + 1 for the upper side

  bool concerns_pair() const { return first != second; }
  friend bool operator==(const Candidate&, const Candidate&) = default;
  /// Orders by time, kind and bodies, so that the order never depends on history.
  friend bool operator<(const Candidate& a, const Candidate& b) {
    if (a.time != b.time) return a.time < b.time;
    return std::tie(a.kind, a.first, a.second, a.face) < std::tie(b.kind, b.first, b.second, b.face);
  }
};

/// The tree of candidate events, with lists of the candidates of each body.
class EventTree {
 public:
  /// Makes room for bodies with numbers below `bodies`.
  void resize(std::size_t bodies) { by_body_.resize(bodies); }

  /// Inserts a candidate. Precondition: no equal candidate is in the tree. Cost: O(log n).
  void insert(const Candidate& candidate);
  bool empty() const { return tree_.empty(); }
  /// Returns the earliest candidate. Precondition: the tree is not empty. Cost: O(1).
  const Candidate& earliest() const { return tree_.begin()->first; }
  /// Removes the earliest candidate and returns it.
  Candidate pop();

  /// Removes the candidates of the body for which unwanted(candidate) is true. A candidate of a pair belongs
  /// to both bodies. Cost: the number of the body's candidates, and O(log n) for each removed one.
  template <class Unwanted>
  void remove_if(std::uint32_t body, Unwanted unwanted);
  void remove_all(std::uint32_t body) {
    remove_if(body, [](const Candidate&) { return true; });
  }

  std::size_t largest_size() const { return largest_size_; }
  std::uint64_t insertions() const { return insertions_; }
  /// Returns the number of candidates that were removed before they were due.
  std::uint64_t removals() const { return removals_; }

 private:
  /// Indices of the candidate in the lists of its first and second body.
  using Places = std::array<std::uint32_t, 2>;
  using Tree = std::map<Candidate, Places>;

  void take_out(Tree::iterator entry);
  void unlist(std::uint32_t body, std::uint32_t place);

  Tree tree_;
  std::vector<std::vector<Tree::iterator>> by_body_;
  std::vector<Tree::node_type> spare_;  ///< nodes kept for their memory
  std::size_t largest_size_ = 0;
  std::uint64_t insertions_ = 0;
  std::uint64_t removals_ = 0;
};

template <class Unwanted>
void EventTree::remove_if(std::uint32_t body, Unwanted unwanted) {
  const auto& entries = by_body_[body];
  // The loop runs from the end: removing an entry moves the last one, visited before, into its place.
  for (std::size_t k = entries.size(); k-- > 0;) {
    if (!unwanted(entries[k]->first)) continue;
    take_out(entries[k]);
    ++removals_;
  }
}

}  // namespace kinesphere
