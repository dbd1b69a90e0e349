// Linked into the examples, for the pictures that examples.py draws of their runs: if KINESPHERE_DRAWN names
// a file, the bodies of the last world of the program are written there, a line for each ball, box and line,
// and where each body came from. They are those at its end or, if there is a KINESPHERE_DRAWN_AT, at that
// time in the last world that has come so far by itself, not as a copy.
#include <kinesphere/run.hpp>
#include <kinesphere/world.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace kinesphere {
namespace {

/// Where the bodies of a world have been.
struct Seen {
  double time = 0.0;
  std::map<std::uint64_t, std::vector<Vec3>> trails{};
  bool is_drawn = false;
};
std::map<const World*, Seen> worlds;

std::uint64_t key_of(BodyId id) { return std::uint64_t{id.index} << 32 | id.generation; }

void draw(const World& world, const Seen& seen) {
  std::FILE* file = std::fopen(std::getenv("KINESPHERE_DRAWN"), "w");
  if (file == nullptr) std::abort();
  const auto line = [&](const char* kind, std::uint64_t user_data, const std::vector<double>& numbers) {
    std::fprintf(file, "%s %llu", kind, static_cast<unsigned long long>(user_data));
    for (const double number : numbers) std::fprintf(file, " %.7g", number);
    std::fputc('\n', file);
  };
  const auto& definition = world.definition();
  if (definition.box) {
    const auto& [low, high] = *definition.box;
    line("space", 0, {low.x, low.y, low.z, high.x, high.y, high.z});
  }
  for (const BodyId id : world.bodies()) {
    const BodyView view = world.body(id).value();
    if (!view.enabled) continue;
    const std::uint64_t user_data = view.definition.user_data;
    const double time = std::max(world.time(), view.bound.time);
    const Vec3 place = view.is_static ? Vec3{} : view.bound.centre_at(time);
    const std::string of = view.is_static ? view.definition.solid ? "static_" : "zone_" : "";
    const auto part = [&](const char* kind, const std::vector<double>& numbers) {
      line((of + kind).c_str(), user_data, numbers);
    };
    if (view.rigid) {
      const Rotation& rotation = view.rigid->rotation;
      const Quaternion turn =
          after(rotation_by(rotation.angular_velocity * (time - view.bound.time)), rotation.orientation);
      for (const RigidPart& each : view.rigid->parts) {
        const Vec3 centre = place + rotated(turn, 0.5 * (each.a + each.b));
        part("ball", {centre.x, centre.y, centre.z, each.radius});
      }
    } else if (const auto* ball = std::get_if<Ball>(&view.shape)) {
      const Vec3 centre = view.is_static ? ball->centre : place;
      part("ball", {centre.x, centre.y, centre.z, ball->radius});
    } else if (const auto* box = std::get_if<Box>(&view.shape)) {
      const Vec3 low = box->lower + place, high = box->upper + place;
      part("box", {low.x, low.y, low.z, high.x, high.y, high.z});
    } else if (const auto* mesh = std::get_if<Mesh>(&view.shape)) {
      // Of a chain, each segment is two triangles, which stand upright.
      for (std::size_t k = 0; k < mesh->size(); k += 2) {
        const Triangle triangle = mesh->triangle(k);
        const bool is_below = triangle.a.x == triangle.b.x && triangle.a.y == triangle.b.y;
        const Vec3 &a = triangle.a, &b = is_below ? triangle.c : triangle.b;
        part("line", {a.x, a.y, a.z, b.x, b.y, b.z});
      }
    }
    if (const auto trail = seen.trails.find(key_of(id)); trail != seen.trails.end()) {
      std::vector<double> numbers;
      for (const Vec3& at : trail->second) numbers.insert(numbers.end(), {at.x, at.y, at.z});
      part("trail", numbers);
    }
  }
  std::fclose(file);
}

void see(const World& world) {
  if (std::getenv("KINESPHERE_DRAWN") == nullptr) return;
  Seen& seen = worlds[&world];
  // Another world in the same place.
  if (world.time() < seen.time) seen = {};
  const double before = std::exchange(seen.time, world.time());
  if (seen.is_drawn || world.bodies().size() > 1000) return;
  for (const BodyId id : world.bodies()) {
    const BodyView view = world.body(id).value();
    if (view.is_static || !view.enabled) continue;
    seen.trails[key_of(id)].push_back(view.bound.centre_at(std::max(world.time(), view.bound.time)));
  }
  const char* wanted = std::getenv("KINESPHERE_DRAWN_AT");
  if (wanted == nullptr || before >= std::atof(wanted) || world.time() < std::atof(wanted)) return;
  // A copy of a world begins later than at 0, and comes from nowhere.
  seen.is_drawn = before > 0;
  if (seen.is_drawn) draw(world, seen);
}

}  // namespace
}  // namespace kinesphere

using namespace kinesphere;

// The linker puts these in the place of World::run() and World::~World() (--wrap). A member function is
// called as a function whose first argument is the object.
Result<void> real_run(World*, double, MotionSource&, const ResponseFn&, const EventFn&,
                      Workers*) asm("__real_" KINESPHERE_RUN);
Result<void> wrapped_run(World* world, double until, MotionSource& source, const ResponseFn& respond,
                         const EventFn& sink, Workers* workers) asm("__wrap_" KINESPHERE_RUN);
Result<void> wrapped_run(World* world, double until, MotionSource& source, const ResponseFn& respond,
                         const EventFn& sink, Workers* workers) {
  Result<void> result = real_run(world, until, source, respond, sink, workers);
  see(*world);
  return result;
}

void real_end(World*) asm("__real_" KINESPHERE_END);
void wrapped_end(World* world) asm("__wrap_" KINESPHERE_END);
void wrapped_end(World* world) {
  if (std::getenv("KINESPHERE_DRAWN") != nullptr && std::getenv("KINESPHERE_DRAWN_AT") == nullptr) {
    // A world that was moved from, or is empty, is no picture.
    bool is_there = true;
    try {
      is_there = !world->bodies().empty();
    } catch (const BadResult&) {
      is_there = false;
    }
    if (is_there) draw(*world, worlds[world]);
    worlds.erase(world);
  }
  real_end(world);
}
