// A motion of one's own: drones that fly to stations, each to its own. First in a world, which tells who
// meets whom. Then in two instances, as in two processes, one for each side of x = 0. A drone that crosses is
// written to bytes by one, read by the other, and flies on to the last bit as if there were one motion for
// all.
#include <kinesphere/kinesphere.hpp>

#include <array>
#include <bit>
#include <cstdio>

using namespace kinesphere;

class Homing final : public PiecewiseAcceleration {
 public:
  Homing() : PiecewiseAcceleration({}, 0.0, 0.5) {}
  std::uint32_t add(const State& state, const Vec3& station) {
    const std::uint32_t body = add_body("Homing::add", 0.0, state).value();
    keep_of(stations_, body, station);
    return body;
  }
  BodyDefinition definition(std::uint32_t body, double t) const override {
    return definition_with(body, t, 3.0);
  }
  std::unique_ptr<Motion> clone() const override { return std::make_unique<Homing>(*this); }

  Result<void> write_body(std::uint32_t body, std::vector<std::byte>& bytes) const override {
    if (!contains(body)) return Error{ErrorCode::unknown_body, "body", {body, 0}, "Homing: no such drone"};
    for (const std::uint64_t word : std::bit_cast<Words>(Drone{origin(body), stations_[body]}))
      for (int k = 0; k < 64; k += 8) bytes.push_back(std::byte(word >> k));
    return {};
  }
  Result<std::uint32_t> read_body(std::span<const std::byte>& bytes) override {
    Words words{};
    if (bytes.size() < sizeof(words)) return bad("end within a drone");
    for (std::size_t k = 0; k < sizeof(words); ++k)
      words[k / 8] |= std::to_integer<std::uint64_t>(bytes[k]) << (k % 8 * 8);
    const auto drone = std::bit_cast<Drone>(words);
    if (!is_finite(drone.station)) return bad("hold a station that is not finite");
    auto body = add_body("add_body", drone.last.time, drone.last.state);
    if (!body) return bad("hold no drone: " + body.error().message);
    keep_of(stations_, *body, drone.station);
    bytes = bytes.subspan(sizeof(words));  // last, so that an error leaves everything unchanged
    return body;
  }

 private:
  /// The complete state of one drone.
  struct Drone {
    MotionOrigin last;
    Vec3 station;
  };
  /// The state as numbers, written with the least significant byte first on every machine.
  using Words = std::array<std::uint64_t, 10>;

  static Error bad(const std::string& why) {
    return {ErrorCode::bad_bytes, "bytes", no_body, "Homing::read_body: bytes " + why};
  }
  Vec3 acceleration(std::uint32_t body, std::int64_t, const State& state) const override {
    const Vec3 wanted = 0.2 * (stations_[body] - state.position) - 0.8 * state.velocity;
    return wanted * (2.9 / (2.9 + norm(wanted)));
  }
  std::vector<Vec3> stations_;
};

/// Flies the drones in a world for a minute, and prints who come within three metres of each other. Returns
/// whether all promises were kept.
static bool fly(Homing& motion) {
  World world = World::create({.contact_tolerance = 1e-4}).value();
  BodyMap bodies;
  bodies.add_all(world, motion, {.radius = 1.5}).value();
  for (const Event& event : world.events(60.0, bodies.probe())) {
    if (event.kind == EventKind::contact_begin)
      std::printf("%6.3f s  drones %u and %u, at %.1f m/s\n", event.time, event.first.index,
                  event.second.index, event.approach_speed);
    if (event.kind == EventKind::bound_violation) return false;
  }
  return true;
}

int main() {
  Homing all, west, east;
  std::vector<MovedBody> drones;  // the drones in `all`, by number
  for (int k = 0; k < 10; ++k) {
    const State start{{k < 5 ? -50.0 : 50.0, 4.0 * (k % 5), 0}, {0, 0, 9}};
    const Vec3 station{30.0 - 8 * k, 4.0 * (k % 5), 0};
    all.add(start, station);
    Homing& motion = k < 5 ? west : east;
    drones.push_back({&motion, motion.add(start, station)});
  }
  Homing flown = all;
  const bool kept = fly(flown);

  int moves = 0, same = 0;
  for (int second = 1; second <= 60; ++second) {
    for (auto& [motion, number] : drones) {
      Homing& owner = motion->state(number, second).position.x < 0 ? west : east;
      if (&owner == motion) continue;
      std::vector<std::byte> bytes;
      motion->write_body(number, bytes).value();
      motion->remove(number).value();
      std::span<const std::byte> arrived = bytes;
      number = owner.read_body(arrived).value();
      motion = &owner;
      ++moves;
    }
  }
  for (std::uint32_t k = 0; k < all.size(); ++k)
    if (drones[k].motion->state(drones[k].number, 60.0) == all.state(k, 60.0)) ++same;
  std::printf("%d moves between motions, %d of 10 drones where they would be in one\n", moves, same);
  return kept && moves > 0 && same == 10 ? 0 : 1;
}
