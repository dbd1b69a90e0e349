// Paths for tests, and where a body is on them by plain arithmetic of its own.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "kinesphere/approaches.hpp"
#include "support/exact_polynomial.hpp"

namespace kinesphere {

struct TestArc {
  std::uint32_t body;
  double begin, end;
  std::vector<Vec3> coefficients;  ///< as many for all arcs
};

/// Owns the arrays that PolynomialPaths refers to.
struct PathSet {
  PolynomialPaths::Basis basis;
  std::vector<TestArc> arcs;
  std::vector<double> errors{};
  std::vector<std::uint32_t> bodies{};
  std::vector<double> begins{}, ends{}, coefficients{};

  PolynomialPaths view() {
    bodies.clear(), begins.clear(), ends.clear(), coefficients.clear();
    for (const TestArc& arc : arcs) {
      bodies.push_back(arc.body), begins.push_back(arc.begin), ends.push_back(arc.end);
      for (int axis = 0; axis < 3; ++axis)
        for (const Vec3& c : arc.coefficients) coefficients.push_back(c[axis]);
    }
    return {basis, arcs.empty() ? 1 : arcs.front().coefficients.size(), bodies, begins, ends, coefficients,
            errors};
  }

  using Wide = exact::Wide;

  /// The coordinate of an arc in quadruple precision, by powers or by T_k = 2 u T_(k-1) - T_(k-2).
  Wide coordinate(const TestArc& arc, int axis, double t) const {
    const Wide begin = arc.begin, end = arc.end;
    const bool is_chebyshev = basis == PolynomialPaths::Basis::chebyshev;
    const Wide u = is_chebyshev ? (2 * Wide(t) - begin - end) / (end - begin) : Wide(t) - begin;
    Wide term = 1, before = u, sum = 0;
    for (const Vec3& c : arc.coefficients) {
      sum += c[axis] * term;
      const Wide next = is_chebyshev ? 2 * u * term - before : u * term;
      before = term;
      term = next;
    }
    return sum;
  }
  /// Returns the distance of two bodies at a time at which both exist. At the seam of two arcs the later
  /// counts.
  std::optional<double> distance(std::uint32_t a, std::uint32_t b, double t) const {
    const TestArc *of_a = nullptr, *of_b = nullptr;
    for (const TestArc& arc : arcs) {
      if (t < arc.begin || t > arc.end) continue;
      if (arc.body == a) of_a = &arc;
      if (arc.body == b) of_b = &arc;
    }
    if (of_a == nullptr || of_b == nullptr) return {};
    Wide square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const Wide d = coordinate(*of_a, axis, t) - coordinate(*of_b, axis, t);
      square += d * d;
    }
    return static_cast<double>(exact::sqrt(square));
  }
};

}  // namespace kinesphere
