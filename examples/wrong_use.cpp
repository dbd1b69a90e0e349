// Wrong use in 48 ways. Nothing crashes, nothing is silently wrong: each results in an error that names the
// call, the argument and the body.
#include <kinesphere/kinesphere.hpp>

#include <cstdio>
#include <functional>
#include <limits>
#include <vector>

using namespace kinesphere;

int ways = 0, unnoticed = 0;

template <class Value>
void refused(const Result<Value>& result, ErrorCode code) {
  const bool noticed = !result && result.error().code == code;
  unnoticed += noticed ? 0 : 1;
  std::printf("%2d  %s\n", ++ways, result ? "NOTHING WAS SAID" : result.error().message.c_str());
}

template <class Call>
void thrown(Call call, ErrorCode code) {
  try {
    refused(Result<decltype(call())>(call()), code);
  } catch (const BadResult& error) {
    refused(Result<void>(error.error()), code);
  }
}

int main() {
  using enum ErrorCode;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Ballistic motion =
      Ballistic::create({.start = {{{}, {1, 0, 0}}, {{10, 0, 0}, {}}, {{0, 30, 0}, {}}}}).value();
  const auto new_world = [] { return World::create({.box = Box{{-99, -99, -99}, {99, 99, 99}}}).value(); };
  World w = new_world(), another = new_world(), tight = World::create({.allow_overlap = false}).value();
  World plane = World::create({.dimensions = 2}).value();
  const BodyId a = w.add(motion.definition(0, 0.0)).value(), b = w.add(motion.definition(1, 0.0)).value();
  const BodyId gone = w.add(motion.definition(2, 0.0)).value(), foreign = another.add({}).value();
  const BodyId post = w.add_static({.shape = Ball{{50, 0, 0}, 1}}).value();
  w.remove(gone).value();
  tight.add({}).value();
  std::vector<std::byte> half = w.save().value();
  half.resize(half.size() / 2);
  const Event hit{.first = a, .second = b, .normal = {1, 0, 0}, .approach_speed = 1};
  // clang-format off
  refused(w.remove(BodyId{77, 0}), unknown_body);                 refused(w.set_velocity(no_body, {}), unknown_body);
  refused(w.change(gone, {.radius = 1}), stale_body);               refused(w.teleport(foreign, {}), foreign_body);
  refused(w.remove(std::vector{a, a}), stale_body);     refused(w.certificates().safe_until(a, a), out_of_range);
  refused(w.certificates().safe_until(a, foreign, 50.0), foreign_body);    refused(w.certificates().earliest_approach(a, -1.0), out_of_range);
  refused(w.add({.velocity = {0, nan, 0}}), not_finite);    refused(w.add({.radius = -0.5}), out_of_range);
  refused(w.change(a, {.radius = nan}), not_finite);                refused(w.sleep(post), static_body);
  refused(w.change(a, {.motion_limits = MotionLimits{.acceleration_limit = -1}}), out_of_range);
  refused(w.set_velocity(a, bounce(hit, nan, 1, 1).first_velocity), not_finite);
  refused(w.add({.position = {500, 0, 0}}), outside_domain); refused(w.teleport(a, {{0, 0, -101}, {}}), outside_domain);
  refused(tight.add({.position = {1e9, 0, 0}}), out_of_range); refused(tight.add({.position = {1, 0, 0}}), overlapping);
  refused(World::create({.contact_tolerance = 0}), out_of_range); refused(World::create({.dimensions = 4}), out_of_range);
  refused(World::create({.box = Box{{0, 0, 0}, {1, 0, 1}}}), out_of_range);
  refused(World::create({.periodic = {true, false, false}}), out_of_range);
  refused(World::create({.box = Box{{0, 0, 0}, {1, 1, 1e12}}}), out_of_range);
  refused(World::create({.box = Box{{0, 0, 0}, {9, 9, 9}}, .periodic = {true, true, true}, .dimensions = 2}), out_of_range);
  refused(plane.add({.position = {0, 0, 1}}), out_of_range); refused(plane.add_zone(Triangle{}), unsupported);
  refused(w.add_static({.shape = Box{{1, 1, 1}, {0, 2, 2}}}), out_of_range);
  refused(w.add_zone(Triangle{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}), out_of_range);
  refused(w.set_sensor(1, {.distances = {5.0, -1.0}}), out_of_range);
  refused(w.set_velocity(post, {}), static_body);            refused(w.enable(a, {}), enabled_body);
  refused(w.queries().ray_cast({}, {}, 1.0), out_of_range);           refused(w.queries().nearest({nan, 0, 0}, 1), not_finite);
  refused(w.advance(nan, motion.probe()), not_finite);      refused(w.advance(-1, motion.probe()), time_backwards);
  refused(w.advance(1, Probe::Function{nullptr}), null_probe);
  refused(w.advance(1, std::function<void(std::span<const BodyId>, double, std::span<State>)>()), null_probe);
  refused(w.advance(20, [](auto, double, auto states) { states[0].position.x = 5; }), not_finite);
  (void)w.advance(w.time() + 10, [&](auto ids, double t, auto s) { if (ways == 38) refused(w.save(), probe_in_progress); motion.probe()(ids, t, s); });
  refused(World::restore(half), bad_snapshot);              refused(Replay::open(half), bad_recording);
  refused(w.stop_recording(), not_recording);               refused(motion.set_velocity(9, 0, {}), unknown_body);
  thrown([&] { return w.body(gone)->enabled; }, stale_body); thrown([&] { return motion.state(9, 0); }, unknown_body);
  thrown([&] { return w.add({.radius = -1}).value(); }, out_of_range); refused(Simulation(new_world()).add(MotionId<>{0}, 0), out_of_range);
  const World taken = std::move(w);                         thrown([&] { return w.time(); }, moved_from);  // NOLINT(bugprone-use-after-move)
  // clang-format on
  std::printf("%d ways, %d unnoticed\n", ways, unnoticed);
  return ways == 48 && unnoticed == 0 ? 0 : 1;
}
