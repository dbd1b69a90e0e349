// What the package needs beside the C interface, which the module exports as it is (include/kinesphere.h).
// Objects are addresses, and calls return statuses as those of C do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "c/exchange.hpp"
#include "c/objects.hpp"
#include "kinesphere/kinesphere.hpp"

/// Exports a function to JavaScript under this name. In the small module a list says which are exported
/// (browser/CMakeLists.txt), and what the others need is left out.
#ifdef KINESPHERE_EXPORTS_BY_LIST
#define KINESPHERE_EXPORT(name) extern "C"
#else
#define KINESPHERE_EXPORT(name) extern "C" __attribute__((export_name(#name), used))
#endif
/// Imports a JavaScript function under this name.
#define KINESPHERE_IMPORT(name) extern "C" __attribute__((import_module("kinesphere"), import_name(#name)))

namespace kinesphere::browser {

/// The numbers that the last call found, if it says that it answers; answer_numbers() has them.
std::vector<double>& answer();

/// The number of a body in JavaScript: its index and, above 32 bits, its generation; -1 for no body.
inline double number_of(BodyId body) {
  return body == no_body ? -1.0 : 4294967296.0 * body.generation + body.index;
}

/// The object behind a Motion of the package.
struct MotionHandle {
  std::shared_ptr<Motion> motion;
};

/// The object behind a BodyMap of the package. It keeps its motions alive, also those that JavaScript frees.
struct BodyMapHandle {
  std::unique_ptr<BodyMap> map;
  std::vector<std::shared_ptr<Motion>> motions;
};

/// Throws BadResult unless the motion has a state of the body at that time.
void require_known(const Motion& motion, std::uint32_t body, double time);
/// Returns the state of the body at that time or at the nearest time at which the motion has one; NaN for an
/// absent body.
State nearest_state(const Motion& motion, std::uint32_t body, double time);

/// The bodies of one motion, numbered by the index of their ids, or those of a map. All calls throw the error
/// of the motion or the map.
class MovedBodies final : public MotionSource {
 public:
  /// One of the two is null.
  MovedBodies(const MotionHandle* motion, const BodyMapHandle* map)
      : motion_(motion != nullptr ? motion->motion.get() : nullptr),
        map_(map != nullptr ? map->map.get() : nullptr) {}
  void states(std::span<const BodyId> ids, double time, std::span<State> states) override;
  MotionOrigin origin(BodyId body) const override;
  void set_origin(BodyId body, const MotionOrigin& origin) override;
  /// Throws if the response turns a body whose motion cannot be changed, as a recorded track.
  void require_possible(const Event& event, const Response& response) const;
  /// Removes what a response has removed from the world from the map and its motions, too.
  void forget_gone(World& world, const Event& event, const Response& response);

 private:
  MovedBody find(BodyId body) const;

  Motion* motion_;
  BodyMap* map_;
};

}  // namespace kinesphere::browser
