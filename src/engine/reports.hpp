// Reports: asking for states, refusing bad ones, and noticing broken promises.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bound/bound_violation.hpp"
#include "engine/bodies.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/result.hpp"
#include "parallel/thread_pool.hpp"

namespace kinesphere {

class Reports {
 public:
  /// The k-th report does not fit what its body promised.
  struct Violation {
    std::size_t k;
    Vec3 velocity;  ///< as it was reported
    BoundViolation limits;
  };

  /// Whom to ask from now on, in the call of this name.
  void ask(const Probe& probe, std::string_view call) {
    probe_ = &probe;
    call_ = call;
  }
  bool is_asking() const { return asking_; }

  /// Asks for the states of bodies at a time, several threads at once if the shift has them. Their bounds
  /// start anew from there. Returns the broken promises, in the order in which the bodies were asked; good
  /// until the next call. Errors: a state that is none; then all bounds stay as they were.
  Result<std::span<const Violation>> take(Bodies& bodies, double time, std::span<const std::uint32_t> numbers,
                                          PoolLease& shift);
  std::size_t bytes() const;

 private:
  void ask_for(const Bodies& bodies, double time, std::span<const std::uint32_t> numbers, PoolLease& shift);
  std::size_t first_bad(const Bodies& bodies, double time, PoolLease& shift) const;
  Result<void> check(const Bodies& bodies, double time, std::size_t k) const;
  void apply_all(Bodies& bodies, double time, PoolLease& shift);
  void apply(Bodies& bodies, double time, std::size_t from, std::size_t to,
             std::vector<Violation>& broken) const;

  // During a call that may probe.
  const Probe* probe_ = nullptr;
  std::string_view call_;  ///< its name, for messages
  bool asking_ = false;
  // Kept for their memory only.
  std::vector<BodyId> ids_;
  std::vector<State> states_;
  std::vector<Violation> violations_;
};

}  // namespace kinesphere
