// Probes of C as probes of the library.
#pragma once

#include "exchange.hpp"
#include "objects.hpp"

namespace kinesphere::c {

/// States of bodies: of those that motions of the world move from these, and of all others from a probe of C.
class CombinedProbe {
 public:
  CombinedProbe(const Simulation& simulation, ks_probe probe, void* user)
      : simulation_(simulation), probe_(probe), user_(user) {}

  void operator()(std::span<const BodyId> ids, double time, std::span<State> states);

 private:
  void ask(std::span<const BodyId> ids, double time, std::span<State> states) const;

  const Simulation& simulation_;
  ks_probe probe_;
  void* user_;
  // Bodies without a motion among those that the world asks for, and their places there.
  std::vector<BodyId> others_{};
  std::vector<State> answers_{};
  std::vector<std::size_t> places_{};
};

/// Calls ask(probe) with the library's probe. Throws BadResult with null_probe if `probe` is null.
template <class Ask>
auto with_probe(std::string_view call, const Simulation& simulation, ks_probe probe, void* user,
                const Ask& ask) {
  if (probe == nullptr) {
    detail::bad_result(
        {ErrorCode::null_probe, "probe", no_body, std::string(call) + ": probe must not be NULL"});
  }
  CombinedProbe combined(simulation, probe, user);
  return ask(Probe(combined));
}

}  // namespace kinesphere::c
