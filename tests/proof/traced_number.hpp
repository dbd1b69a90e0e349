// A number that records its operations, so that a function of the library can be written down as a term.
//
// Operations make nodes of a graph; equal ones are one node. A comparison needs a decision: term_of() runs
// the function once for each way through it, so that the term has all of them, as `if ... then ... else`. The
// order in which the compiler evaluates operands has no effect.
#pragma once

#include <cctype>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace traced {

struct Node {
  std::string operation;  ///< or, without operands, the text of a leaf
  std::vector<const Node*> operands;
};

/// Returns the unique node of this operation.
inline const Node* node_of(const std::string& operation, const std::vector<const Node*>& operands = {}) {
  static std::map<std::pair<std::string, std::vector<const Node*>>, std::unique_ptr<Node>> nodes;
  std::unique_ptr<Node>& node = nodes[{operation, operands}];
  if (!node) node = std::make_unique<Node>(Node{operation, operands});
  return node.get();
}

/// Returns m 2^e, exactly.
inline const Node* literal(double value) {
  if (std::signbit(value)) return node_of("-", {literal(-value)});
  if (std::isinf(value)) return node_of("infinity");
  int exponent = 0;
  double mantissa = std::frexp(value, &exponent);
  while (mantissa != std::trunc(mantissa)) {
    mantissa *= 2.0;
    --exponent;
  }
  if (mantissa == 0.0) exponent = 0;
  while (mantissa != 0.0 && exponent > 0 && exponent < 10) {
    mantissa *= 2.0;
    --exponent;
  }
  const std::string power = std::to_string(exponent);
  return node_of("literal " + std::to_string(static_cast<long long>(mantissa)) + " " +
                 (exponent < 0 ? "(" + power + ")" : power));
}

struct Undecided {
  const Node* condition;
};

/// Decisions of the comparisons on the way.
inline std::map<const Node*, bool>& decisions() {
  static std::map<const Node*, bool> decided;
  return decided;
}

inline bool decide(const Node* condition) {
  const auto found = decisions().find(condition);
  if (found == decisions().end()) throw Undecided{condition};
  return found->second;
}

/// A double.
class Double {
 public:
  constexpr Double() = default;
  template <class Value, class = std::enable_if_t<std::is_arithmetic_v<Value>>>
  constexpr Double(Value value) : constant_(static_cast<double>(value)) {}  // NOLINT
  explicit Double(const Node* node) : node_(node) {}

  const Node* node() const { return node_ != nullptr ? node_ : literal(constant_); }

  friend constexpr Double operator+(Double a, Double b) {
    if (std::is_constant_evaluated()) return a.constant_ + b.constant_;
    return binary("+", a, b);
  }
  friend constexpr Double operator-(Double a, Double b) {
    if (std::is_constant_evaluated()) return a.constant_ - b.constant_;
    return binary("-", a, b);
  }
  friend constexpr Double operator*(Double a, Double b) {
    if (std::is_constant_evaluated()) return a.constant_ * b.constant_;
    return binary("*", a, b);
  }
  friend constexpr Double operator/(Double a, Double b) {
    if (std::is_constant_evaluated()) return a.constant_ / b.constant_;
    return binary("/", a, b);
  }
  friend constexpr Double operator-(Double a) {
    if (std::is_constant_evaluated()) return -a.constant_;
    return Double(node_of("-", {a.node()}));
  }
  constexpr Double& operator+=(Double b) { return *this = *this + b; }
  constexpr Double& operator-=(Double b) { return *this = *this - b; }
  constexpr Double& operator*=(Double b) { return *this = *this * b; }

  friend constexpr bool operator<(Double a, Double b) {
    if (std::is_constant_evaluated() || are_constant(a, b)) return a.constant_ < b.constant_;
    return compare("<?", a, b);
  }
  friend constexpr bool operator<=(Double a, Double b) {
    if (std::is_constant_evaluated() || are_constant(a, b)) return a.constant_ <= b.constant_;
    return compare("<=?", a, b);
  }
  friend constexpr bool operator==(Double a, Double b) {
    if (std::is_constant_evaluated() || are_constant(a, b)) return a.constant_ == b.constant_;
    return compare("=?", a, b);
  }
  friend constexpr bool operator>(Double a, Double b) { return b < a; }
  friend constexpr bool operator>=(Double a, Double b) { return b <= a; }

 private:
  static constexpr bool are_constant(Double a, Double b) { return a.node_ == nullptr && b.node_ == nullptr; }
  static Double binary(const char* operation, Double a, Double b) {
    return Double(node_of(operation, {a.node(), b.node()}));
  }
  static bool compare(const std::string& operation, Double a, Double b) {
    return decide(node_of(operation, {a.node(), b.node()}));
  }

  const Node* node_ = nullptr;
  double constant_ = 0.0;
};

inline Double variable(const std::string& name) { return Double(node_of(name)); }

/// The result of another term with these arguments.
template <class... Values>
Double call(const std::string& term, Values... values) {
  return Double(node_of(term, {values.node()...}));
}

struct Term {
  const Node* condition = nullptr;
  std::unique_ptr<Term> yes, no;
  const Node* answer = nullptr;
};

inline Term term_of(const std::function<Double()>& function) {
  try {
    return {.answer = function().node()};
  } catch (const Undecided& undecided) {
    bool& decided = decisions()[undecided.condition];
    Term term{.condition = undecided.condition};
    decided = true;
    term.yes = std::make_unique<Term>(term_of(function));
    decided = false;
    term.no = std::make_unique<Term>(term_of(function));
    decisions().erase(undecided.condition);
    return term;
  }
}

/// Prints a term in Gallina, the language of Coq. A long node, or one that is used more than once, has a
/// name.
class Printer {
 public:
  explicit Printer(const Term& term) {
    count(term);
    print(term, 1, {}, 0);
  }
  std::string text() const { return text_.str(); }

 private:
  using Names = std::map<const Node*, std::string>;

  void count(const Term& term) {
    if (term.condition != nullptr) {
      count(term.condition);
      count(*term.yes);
      count(*term.no);
    }
    if (term.answer != nullptr) count(term.answer);
  }
  void count(const Node* node) {
    if (uses_[node]++ > 0) return;
    sizes_[node] = 1;
    for (const Node* operand : node->operands) {
      count(operand);
      if (!has_name(operand)) sizes_[node] += sizes_[operand];
    }
  }
  bool has_name(const Node* node) const {
    return !node->operands.empty() && (uses_.at(node) > 1 || sizes_.at(node) > 12);
  }

  void print(const Term& term, int depth, Names names, int named) {
    const std::string indent(static_cast<std::size_t>(2 * depth), ' ');
    const auto introduce = [&](const Node* node) { name_parts(node, indent, names, named); };
    if (term.condition == nullptr) {
      for (const Node* operand : term.answer->operands) introduce(operand);
      text_ << indent << expression(term.answer, names, false);
      return;
    }
    for (const Node* operand : term.condition->operands) introduce(operand);
    text_ << indent << "if " << expression(term.condition, names, false) << " then\n";
    print(*term.yes, depth + 1, names, named);
    text_ << "\n" << indent << "else\n";
    // Nested comparisons would go ever farther to the right.
    print(*term.no, depth, names, named);
  }

  void name_parts(const Node* node, const std::string& indent, Names& names, int& named) {
    if (names.contains(node)) return;
    for (const Node* operand : node->operands) name_parts(operand, indent, names, named);
    if (!has_name(node)) return;
    const std::string right = expression(node, names, false);
    const std::string name = "t" + std::to_string(++named);
    text_ << indent << "let " << name << " := " << right << " in\n";
    names[node] = name;
  }

  static std::string expression(const Node* node, const Names& names, bool inner) {
    if (const auto named = names.find(node); named != names.end()) return named->second;
    const std::string& operation = node->operation;
    const auto operand = [&](std::size_t k) { return expression(node->operands[k], names, true); };
    std::string text;
    if (node->operands.empty()) {
      text = operation;
      inner = inner && text.find(' ') != std::string::npos;
    } else if (std::isalpha(operation[0]) != 0) {
      text = operation;
      for (std::size_t k = 0; k < node->operands.size(); ++k) text += " " + operand(k);
    } else if (node->operands.size() == 1) {
      text = operation + " " + operand(0);
    } else {
      text = operand(0) + " " + operation + " " + operand(1);
    }
    return inner ? "(" + text + ")" : text;
  }

  std::map<const Node*, int> uses_;
  std::map<const Node*, int> sizes_;
  std::ostringstream text_;
};

/// Returns a definition of this name.
inline std::string definition(const std::string& head, const std::function<Double()>& function) {
  const Term term = term_of(function);
  return "Definition " + head + " :=\n" + Printer(term).text() + ".\n";
}

}  // namespace traced

/// Replaces std:: in the library's sources when they compute with traced numbers.
namespace traced_std {

using namespace std;  // NOLINT
using std::abs, std::sqrt, std::isinf, std::isfinite, std::max, std::min;

inline traced::Double abs(traced::Double x) {
  return traced::Double(traced::node_of("magnitude", {x.node()}));
}
inline traced::Double sqrt(traced::Double x) { return traced::Double(traced::node_of("root", {x.node()})); }
inline bool isinf(traced::Double x) { return traced::decide(traced::node_of("infinite", {x.node()})); }
inline bool isfinite(traced::Double x) { return traced::decide(traced::node_of("is_finite", {x.node()})); }
inline traced::Double max(traced::Double a, traced::Double b) { return a < b ? b : a; }
inline traced::Double min(traced::Double a, traced::Double b) { return b < a ? b : a; }

template <class Value>
struct numeric_limits : std::numeric_limits<Value> {};
template <>
struct numeric_limits<traced::Double> {
  static constexpr traced::Double min() { return std::numeric_limits<double>::min(); }
  static constexpr traced::Double infinity() { return std::numeric_limits<double>::infinity(); }
};

}  // namespace traced_std
