// Marble run: eight marbles race down ramps as thin as lines, each a chain of segments, and the finish is a
// zone. A ramp is never missed, however fast a marble is, and the times at the finish are exact: a photo
// finish needs no photo. A race in frames of another length ends alike.
#include <kinesphere/game_world.hpp>
#include <kinesphere/response.hpp>

#include <algorithm>
#include <cstdio>
#include <vector>

using namespace kinesphere;

namespace {

constexpr std::uint64_t finish_kind = 99;

/// Marbles bounce; at the finish they are taken off.
Response respond(const Event& event) {
  if (event.kind == EventKind::contact_begin || event.kind == EventKind::wall_begin)
    return response_of(event, bounce(event, 0.5));
  if (event.kind != EventKind::sensor_enter) return {};
  Response response;
  (event.first_user_data == finish_kind ? response.second_action : response.first_action) =
      BodyAction::remove;
  return response;
}

struct Arrival {
  std::uint64_t marble = 0;
  double time = 0;
};

std::vector<Arrival> race(double dt) {
  GameWorld game = GameWorld::create({.world = {.box = Box{{0, 0, 0}, {12, 22, 0}},
                                                .dimensions = 2,
                                                .contact_tolerance = 1e-4,
                                                .contacts = ContactEvents::impacts},
                                      .gravity = {0, -9.81, 0},
                                      .response = respond})
                       .value();
  // Ramps lead to and fro, and each ends in a lip that throws the marbles onto the next.
  for (int ramp = 0; ramp < 5; ++ramp) {
    const bool right = ramp % 2 == 0;
    const auto at = [&](double x, double y) { return Vec3{right ? x : 12 - x, 18 - 3.6 * ramp + y, 0}; };
    const Vec3 corners[] = {at(0, 2), at(3, 0.8), at(6, 0.1), at(8, 0), at(9.2, 0.3)};
    game.add_static({.shape = Mesh::chain(corners).value()}).value();
  }
  game.add_zone(Box{{0, 0, 0}, {12, 0.5, 0}}, finish_kind).value();
  for (std::uint64_t marble = 0; marble < 8; ++marble) {
    const double x = 0.5 + 0.45 * static_cast<double>(marble);
    game.add({.radius = 0.15 + 0.01 * static_cast<double>(marble),
              .position = {x, 21.5, 0},
              .user_data = marble})
        .value();
  }
  std::vector<Arrival> arrivals;
  while (arrivals.size() < 8 && game.time() < 120) {
    for (const Event& event : game.step(dt).value())
      if (event.kind == EventKind::sensor_enter)
        arrivals.push_back({std::min(event.first_user_data, event.second_user_data), event.time});
  }
  return arrivals;
}

}  // namespace

int main() {
  const std::vector<Arrival> again = race(0.37), arrivals = race(1.0 / 60);
  for (std::size_t k = 0; k < arrivals.size(); ++k)
    std::printf("%zu. marble %d after %.6f s\n", k + 1, static_cast<int>(arrivals[k].marble),
                arrivals[k].time);
  bool alike = arrivals.size() == 8 && again.size() == 8;
  for (std::size_t k = 0; alike && k < 8; ++k)
    alike = arrivals[k].marble == again[k].marble && arrivals[k].time == again[k].time;
  std::printf("in frames of 0.37 s: %s\n", alike ? "the same, to the last bit" : "another race");
  return alike ? 0 : 1;
}
