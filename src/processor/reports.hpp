// Reports probes bodies, rejects invalid reports and detects violated bounds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "bodies/bodies.hpp"
#include "bound/bound_violation.hpp"
#include "kinesphere/probe.hpp"
#include "kinesphere/result.hpp"
#include "parallel/thread_pool.hpp"
#include "processor/probe_profile.hpp"

namespace kinesphere {

class Reports {
 public:
  /// The k-th report violates the bound of its body.
  struct Violation {
    std::size_t k;
    Vec3 velocity;  ///< as reported, in the image of the bound
    BoundViolation limits;
    double acceleration_limit;  ///< of the body from now on
  };

  /// Sets the probe to call from now on, the name of the API call, for error messages, and threads that may
  /// all call the probe, if there are any. The probe and the lease must outlive their use here.
  void ask(const Probe& probe, std::string_view call, PoolLease* lease = nullptr) {
    probe_ = &probe;
    call_ = call;
    lease_ = lease;
  }
  bool is_asking() const { return asking_; }
  /// Returns the threads of ask(); nullptr if there are none.
  PoolLease* lease() const { return lease_; }

  /// Sets the profile that counts probes from now on; nullptr for none. It must outlive its use here.
  void set_profile(ProbeProfile* profile) { profile_ = profile; }
  ProbeProfile* profile() const { return profile_; }

  /// Probes bodies at a time, and starts their bounds anew from the reports. Returns the violated bounds in
  /// the order of `numbers`; the span is valid until the next call. `work`: threads that share all but the
  /// calls of the probe, which those of ask() share. Errors: an invalid state; then all bounds are unchanged.
  Result<std::span<const Violation>> take(Bodies& bodies, double time, std::span<const std::uint32_t> numbers,
                                          PoolLease& work);
  /// Probes exact bodies as take() does, without changing anything. Returns those whose reports violate their
  /// bounds. Errors: an invalid state.
  Result<std::vector<std::uint32_t>> contradicted(const Bodies& bodies, double time,
                                                  std::span<const std::uint32_t> numbers);
  std::size_t bytes() const;

 private:
  bool take_few(Bodies& bodies, double time, std::span<const std::uint32_t> numbers);
  void ask_for(const Bodies& bodies, double time, std::span<const std::uint32_t> numbers, PoolLease& work);
  std::size_t first_bad(const Bodies& bodies, double time, PoolLease& lease) const;
  Result<void> check(const Bodies& bodies, double time, std::size_t k) const;
  void ask_rotations(const Bodies& bodies, double time);
  void apply_all(Bodies& bodies, double time, std::span<const std::uint32_t> numbers, PoolLease& lease);
  bool apply_plain(Bodies& bodies, double time, std::uint32_t number, const State& reported) const;
  void apply(Bodies& bodies, double time, std::size_t k, std::vector<Violation>& broken) const;
  static void adopt(const Bodies& bodies, Body& body, const Bound& before, const Bound& after, double radius);
  std::optional<BoundViolation> turn(RigidRecord& record, const Body& body, const Bound& before,
                                     std::size_t k) const;

  // Set during calls that may probe.
  const Probe* probe_ = nullptr;
  std::string_view call_;  ///< name of the API call, for error messages
  PoolLease* lease_ = nullptr;
  bool asking_ = false;
  ProbeProfile* profile_ = nullptr;
  // Members only to reuse their memory.
  std::vector<BodyId> ids_;
  std::vector<State> states_;
  std::vector<Rotation> rotations_;  ///< by report; empty unless a RotationProbe gave them
  std::vector<Violation> violations_;
};

}  // namespace kinesphere
