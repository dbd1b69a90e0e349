// Interface of hand-tuned fixed-step detectors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace kinesphere::program {

/// Centres of all spheres at one step, by body, in single precision as such programs keep them.
struct Frame {
  const float* x;
  const float* y;
  const float* z;
};

struct SpherePair {
  std::uint32_t first;
  std::uint32_t second;
};

enum class SphereTest {
  at_steps,  ///< spheres touch if they overlap at a step; contacts in between are not seen
  swept,     ///< spheres touch if they overlap anywhere on their straight ways from one step to the next
};

/// A detector for fixed steps, and nothing else: its caller moves the spheres and answers contacts.
class StepKernel {
 public:
  virtual ~StepKernel() = default;

  virtual std::string name() const = 0;
  /// Appends the pairs that touch in the step from `before` to `now`, each once, in any order. `before` is
  /// the `now` of the last call; in the first call it equals `now`.
  virtual void look(const Frame& before, const Frame& now, std::vector<SpherePair>& touching) = 0;
  /// Returns the memory of the detector (bytes).
  virtual std::size_t bytes() const = 0;
};

}  // namespace kinesphere::program
