// Bodies that migrate from one motion to another as bytes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "kinesphere/motion/ballistic.hpp"
#include "kinesphere/motion/frame_motion.hpp"
#include "kinesphere/motion/piecewise_motion.hpp"
#include "kinesphere/motion/random_forces.hpp"
#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/motion/steered_motion.hpp"
#include "kinesphere/motion/velocity_field.hpp"
#include "motion/motion_properties.hpp"
#include "motion/still.hpp"

namespace kinesphere::body_bytes_test {
namespace {

using Bytes = std::vector<std::byte>;

constexpr std::uint32_t bodies = 6;

/// Two motions of equal definitions: one with bodies, one without.
struct Pair {
  std::unique_ptr<Motion> here;
  std::unique_ptr<Motion> there;
};

template <class M, class Definition>
Pair pair_of(Definition definition) {
  Pair pair;
  pair.here = std::make_unique<M>(M::create(definition).value());
  definition.start.clear();
  if constexpr (requires { definition.acceleration_limits; }) definition.acceleration_limits.clear();
  if constexpr (requires { definition.velocities; }) definition.velocities.clear();
  pair.there = std::make_unique<M>(M::create(definition).value());
  return pair;
}

std::vector<double> random_limits(Random& random) {
  std::vector<double> limits(bodies);
  for (double& limit : limits) limit = random.uniform(0, 20);
  return limits;
}

Pair ballistic(Random& random) {
  return pair_of<Ballistic>(BallisticDefinition{.start = random_states(random, bodies, 100, 30),
                                                .gravity = 10 * random.point_in_ball(),
                                                .start_time = random.uniform(-5, 5)});
}

Pair random_forces(Random& random) {
  return pair_of<RandomForces>(RandomForcesDefinition{.start = random_states(random, bodies, 100, 30),
                                                      .acceleration_limits = random_limits(random),
                                                      .interval = random.uniform(0.05, 2),
                                                      .seed = random.bits(),
                                                      .start_time = random.uniform(-5, 5)});
}

Pair steered(Random& random) {
  return pair_of<SteeredMotion>(SteeredMotionDefinition{.start = random_states(random, bodies, 100, 30),
                                                        .acceleration_limits = random_limits(random)});
}

Pair velocity_field(Random& random) {
  return pair_of<VelocityField>(
      VelocityFieldDefinition{.field = Circulation{{{-100, -80, -60}, {100, 80, 60}}, 40},
                              .start = random_states(random, bodies, 60, 30),
                              .acceleration_limits = random_limits(random),
                              .interval = random.uniform(0.05, 0.5)});
}

Pair piecewise_motion(Random& random) {
  std::vector<Trajectory> trajectories(bodies);
  for (Trajectory& trajectory : trajectories) {
    State state = random_states(random, 1, 100, 30).front();
    double time = random.uniform(-5, 5);
    for (std::uint64_t k = random.bits() % 8; k < 8; ++k) {
      const double end = time + random.uniform(0.1, 2);
      trajectory.push_back({time, end, state.position, state.velocity, 9 * random.point_in_ball(),
                            5 * random.point_in_ball()});
      state = trajectory.back().state_at(end);
      time = end;
    }
  }
  return {std::make_unique<PiecewiseMotion>(PiecewiseMotion::create(trajectories).value()),
          std::make_unique<PiecewiseMotion>(PiecewiseMotion::create({}).value())};
}

Pair recorded_tracks(Random& random) {
  std::vector<Track> tracks(bodies);
  for (Track& track : tracks) {
    double time = random.uniform(-5, 5);
    for (std::uint64_t k = random.bits() % 19; k < 20; ++k) {
      track.push_back({time, 50 * random.point_in_ball()});
      // Pieces of splines with very different durations meet less exactly than create() requires.
      time += std::pow(10.0, random.uniform(-7.0, 7.0));
    }
  }
  return {std::make_unique<RecordedTracks>(RecordedTracks::create(tracks).value()),
          std::make_unique<RecordedTracks>(RecordedTracks::create({}).value())};
}

/// Frames with limits that permit all steps of next_frame().
Pair frames(Random& random) {
  std::vector<double> limits = random_limits(random);
  for (double& limit : limits) limit += 1e6;
  FrameMotionDefinition definition{.start = {},
                                   .acceleration_limits = std::move(limits),
                                   .interval = random.uniform(0.01, 0.5),
                                   .position_error = random.uniform(0, 1e-3),
                                   .start_time = random.uniform(-5, 5)};
  for (const State& state : random_states(random, bodies, 100, 30)) {
    definition.start.push_back(state.position);
    definition.velocities.push_back(state.velocity);
  }
  return pair_of<FrameMotion>(std::move(definition));
}

/// Frames that have had a time of their own, so that all later ones do.
Pair timed_frames(Random& random) {
  Pair motions = frames(random);
  for (Motion* motion : {motions.here.get(), motions.there.get()}) {
    auto& timed = dynamic_cast<FrameMotion&>(*motion);
    timed.push(timed.latest(), timed.latest_time() + 1e-3).value();
  }
  return motions;
}

/// Compares bit for bit: 0 and -0 differ.
template <class T>
bool same_bits(const T& a, const T& b) {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(double) == 0);
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

bool same_promise(const BodyDefinition& a, const BodyDefinition& b) {
  return same_bits(a.position, b.position) && same_bits(a.velocity, b.velocity) &&
         same_bits(a.planned_acceleration, b.planned_acceleration) &&
         same_bits(a.acceleration_limit, b.acceleration_limit) &&
         same_bits(a.position_error, b.position_error) && same_bits(a.velocity_error, b.velocity_error);
}

Bytes bytes_of(const Motion& motion, std::uint32_t body) {
  Bytes bytes;
  motion.write_body(body, bytes).value();
  return bytes;
}

/// Returns the state of a motion, except its definition.
std::vector<std::optional<Bytes>> content(const Motion& motion) {
  std::vector<std::optional<Bytes>> result(motion.size());
  for (std::uint32_t body = 0; body < motion.size(); ++body)
    if (motion.contains(body)) result[body] = bytes_of(motion, body);
  return result;
}

/// Reads one body; expects that no bytes are left.
std::uint32_t read(Motion& motion, std::span<const std::byte> bytes) {
  const std::uint32_t body = motion.read_body(bytes).value();
  RC_ASSERT(bytes.empty());
  return body;
}

/// Returns the times at which the body may be queried, and at which it may be changed.
std::pair<double, double> known_times(const Motion& motion, std::uint32_t body, bool changeable) {
  const double begin = changeable ? motion.origin(body).time : -10.0;
  const auto* const frames = dynamic_cast<const FrameMotion*>(&motion);
  return {begin, frames != nullptr ? frames->latest_time() : begin + 25.0};
}

/// Expects that a body in one motion equals a body in another, in all queries.
void require_same(const Motion& motion, std::uint32_t body, const Motion& other, std::uint32_t number,
                  bool changeable, Random& random) {
  RC_ASSERT(bytes_of(motion, body) == bytes_of(other, number));
  if (changeable) RC_ASSERT(same_bits(motion.origin(body), other.origin(number)));
  const auto [begin, end] = known_times(motion, body, changeable);
  for (int k = 0; k < 6; ++k) {
    const double t = random.uniform(begin, end);
    const double later = random.uniform(t, end);
    RC_ASSERT(same_bits(motion.state(body, t), other.state(number, t)));
    RC_ASSERT(same_promise(motion.definition(body, t), other.definition(number, t)));
    const Trajectory expected = motion.trajectory(body, t, later);
    const Trajectory found = other.trajectory(number, t, later);
    RC_ASSERT(std::ranges::equal(expected, found, same_bits<Segment>));
  }
}

/// A body in its first motion and in the motion that has read it.
struct Traveller {
  std::uint32_t here;
  std::uint32_t there;
};

/// Pushes the next frame in both motions, if they have frames: every body moves, and travellers to one place
/// in both.
void next_frame(const Pair& motions, std::span<const Traveller> travellers, Random& random) {
  auto* const here = dynamic_cast<FrameMotion*>(motions.here.get());
  auto* const there = dynamic_cast<FrameMotion*>(motions.there.get());
  if (here == nullptr) return;
  std::vector<Vec3> positions_here = here->latest(), positions_there = there->latest();
  for (Vec3& position : positions_here) position += random.point_in_ball();
  for (const auto& [body, number] : travellers) positions_there[number] = positions_here[body];
  std::optional<double> time;
  if (!here->has_equal_frames()) time = here->latest_time() + random.uniform(0.01, 1.0);
  here->push(positions_here, time).value();
  there->push(positions_there, time).value();
}

/// Returns a change of a body that all motions of this kind accept.
std::function<void(Motion&, std::uint32_t)> random_change(const Motion& motion, std::uint32_t body,
                                                          Random& random) {
  const auto [begin, end] = known_times(motion, body, true);
  const double t = random.uniform(begin, end);
  const State state = random_states(random, 1, 100, 30).front();
  const MotionOrigin last = motion.origin(body);
  switch (random.bits() % 4) {
    case 0:
      return [=](Motion& changed, std::uint32_t number) { changed.teleport(number, t, state).value(); };
    case 1:
      if (dynamic_cast<const FrameMotion*>(&motion) == nullptr)
        return [=](Motion& changed, std::uint32_t number) {
          changed.set_origin(number, {last.time - 0.5, state}).value();
        };
      return [=](Motion& changed, std::uint32_t number) { changed.set_origin(number, {t, state}).value(); };
    case 2:
      if (dynamic_cast<const SteeredMotion*>(&motion) != nullptr) {
        const Vec3 push = motion.definition(body, t).acceleration_limit * 0.9 * random.unit_vector();
        return [=](Motion& changed, std::uint32_t number) {
          dynamic_cast<SteeredMotion&>(changed).steer(number, t, push).value();
        };
      }
      [[fallthrough]];
    default:
      return [=](Motion& changed, std::uint32_t number) {
        changed.set_velocity(number, t, state.velocity).value();
      };
  }
}

struct Maker {
  std::string name;
  Pair (*make)(Random&);
  bool changeable;
};

class BodyBytes : public testing::TestWithParam<Maker> {
 protected:
  /// Returns a pair with some history: bodies have been changed, and the second motion has bodies and gaps.
  Pair used_pair(Random& random) const {
    Pair motions = GetParam().make(random);
    for (int k = 0; k < 4; ++k) {
      next_frame(motions, {}, random);
      change_some(*motions.here, random);
    }
    for (std::uint64_t k = random.bits() % 4; k > 0; --k) {
      read(*motions.there, bytes_of(*motions.here, random_body(random, *motions.here)));
      const std::uint32_t gap = random_body(random, *motions.there);
      if (random.bits() % 2 == 0 && motions.there->contains(gap)) motions.there->remove(gap).value();
    }
    return motions;
  }

  void change_some(Motion& motion, Random& random) const {
    if (!GetParam().changeable) return;
    for (std::uint32_t body = 0; body < motion.size(); ++body)
      if (random.bits() % 2 == 0) random_change(motion, body, random)(motion, body);
  }

  void require_same_here_and_there(const Pair& motions, const Traveller& traveller, Random& random) const {
    require_same(*motions.here, traveller.here, *motions.there, traveller.there, GetParam().changeable,
                 random);
  }
};

TEST_P(BodyBytes, GoOnElsewhereAsTheyWould) {
  EXPECT_TRUE(rc::check([&](std::uint64_t seed) {
    Random random(seed);
    const Pair motions = used_pair(random);

    // Half of the bodies, appended to the bytes one after the other.
    std::vector<Traveller> travellers;
    const Bytes before{std::byte{7}, std::byte{9}};
    Bytes bytes = before;
    for (std::uint32_t body = 0; body < bodies; body += 2) {
      travellers.push_back({body, 0});
      motions.here->write_body(body, bytes).value();
    }
    RC_ASSERT(std::equal(before.begin(), before.end(), bytes.begin()));
    bytes.insert(bytes.end(), 5, std::byte{1});
    std::span<const std::byte> rest = std::span(bytes).subspan(before.size());
    for (Traveller& traveller : travellers) traveller.there = motions.there->read_body(rest).value();
    RC_ASSERT(rest.size() == 5u);
    for (const Traveller& traveller : travellers) require_same_here_and_there(motions, traveller, random);

    // Equal changes in both motions.
    for (int k = 0; k < 5; ++k) {
      next_frame(motions, travellers, random);
      for (const Traveller& traveller : travellers) {
        if (GetParam().changeable && random.bits() % 2 == 0) {
          const auto change = random_change(*motions.here, traveller.here, random);
          change(*motions.here, traveller.here);
          change(*motions.there, traveller.there);
        }
        require_same_here_and_there(motions, traveller, random);
      }
    }

    // The travellers leave, and the others are unaffected.
    const auto all = motions.here->clone();
    for (const Traveller& traveller : travellers) {
      motions.here->remove(traveller.here).value();
      Bytes none;
      RC_ASSERT(motions.here->write_body(traveller.here, none).error().code == ErrorCode::stale_body);
      RC_ASSERT(none.empty());
    }
    for (std::uint32_t body = 0; body < bodies; ++body) {
      RC_ASSERT(motions.here->contains(body) == (body % 2 != 0));
      if (body % 2 != 0) require_same(*all, body, *motions.here, body, GetParam().changeable, random);
    }

    // The travellers return, with other numbers.
    for (const Traveller& traveller : travellers) {
      const std::uint32_t back = read(*motions.here, bytes_of(*motions.there, traveller.there));
      motions.there->remove(traveller.there).value();
      require_same(*all, traveller.here, *motions.here, back, GetParam().changeable, random);
    }
    // Frames use the number of a removed body only after the next push.
    const bool has_frames = dynamic_cast<const FrameMotion*>(motions.here.get()) != nullptr;
    RC_ASSERT(motions.here->size() == bodies + (has_frames ? travellers.size() : 0));
  }));
}

void require_refused(const Result<std::uint32_t>& refused) {
  RC_ASSERT(refused.error().code == ErrorCode::bad_bytes);
  RC_ASSERT(refused.error().argument == "bytes");
  RC_ASSERT(refused.error().message.starts_with("read_body: bytes "));
}

TEST_P(BodyBytes, AreRefusedWhenCut) {
  EXPECT_TRUE(rc::check([&](std::uint64_t seed) {
    Random random(seed);
    const Pair motions = used_pair(random);
    const auto before = content(*motions.there);
    const Bytes whole = bytes_of(*motions.here, random_body(random, *motions.here));
    for (std::size_t size = 0; size < whole.size(); ++size) {
      const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      std::span<const std::byte> bytes = cut;
      require_refused(motions.there->read_body(bytes));
      RC_ASSERT(bytes.data() == cut.data());
      RC_ASSERT(bytes.size() == size);
    }
    RC_ASSERT(content(*motions.there) == before);
  }));
}

TEST_P(BodyBytes, AreRefusedOrMakeSenseWhenDamaged) {
  std::size_t refused = 0;
  EXPECT_TRUE(rc::check([&](std::uint64_t seed) {
    Random random(seed);
    const Pair motions = used_pair(random);
    const Bytes whole = bytes_of(*motions.here, random_body(random, *motions.here));
    for (std::size_t k = 0; k < whole.size(); ++k) {
      Bytes damaged = whole;
      const std::size_t number = 4 + k / 8 * 8;
      if (random.bits() % 2 == 0 && number + 8 <= whole.size()) {
        // NaN, which single changed bytes seldom make.
        std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(number), 8, std::byte{0xff});
      } else {
        damaged[k] ^= static_cast<std::byte>(1 + random.bits() % 255);
      }
      std::span<const std::byte> bytes = damaged;
      const auto before = content(*motions.there);
      const auto body = motions.there->read_body(bytes);
      if (body) {
        RC_ASSERT(motions.there->contains(*body));
        const auto length = damaged.size() - bytes.size();
        RC_ASSERT(std::ranges::equal(bytes_of(*motions.there, *body), std::span(damaged).first(length)));
        motions.there->remove(*body).value();
      } else {
        ++refused;
        require_refused(body);
        RC_ASSERT(bytes.data() == damaged.data());
        RC_ASSERT(bytes.size() == damaged.size());
        RC_ASSERT(content(*motions.there) == before);
      }
    }
  }));
  EXPECT_GT(refused, 0u);
}

TEST_P(BodyBytes, RefuseBodiesThatAreNotThereAndThoseOfOtherMotions) {
  Random random(1);
  const Pair motions = GetParam().make(random);
  Bytes bytes;
  const auto unknown = motions.here->write_body(bodies, bytes);
  EXPECT_EQ(unknown.error().code, ErrorCode::unknown_body);
  EXPECT_EQ(unknown.error().body, (BodyId{bodies, 0}));
  EXPECT_TRUE(bytes.empty());
  Bytes foreign = bytes_of(*motions.here, 0);
  foreign[0] = std::byte{99};
  std::span<const std::byte> rest = foreign;
  const auto refused = motions.there->read_body(rest);
  EXPECT_NE(refused.error().message.find("but begin with 99"), std::string::npos) << refused.error().message;
  EXPECT_EQ(motions.there->size(), 0u);
}

INSTANTIATE_TEST_SUITE_P(
    All, BodyBytes,
    testing::Values(Maker{"Ballistic", ballistic, true}, Maker{"RandomForces", random_forces, true},
                    Maker{"Steered", steered, true}, Maker{"VelocityField", velocity_field, true},
                    Maker{"PiecewiseMotion", piecewise_motion, false},
                    Maker{"RecordedTracks", recorded_tracks, false}, Maker{"Frames", frames, true},
                    Maker{"TimedFrames", timed_frames, true}),
    [](const auto& test) { return test.param.name; });

/// Appends the bytes of a number, the least significant one first, on every machine.
void append(Bytes& bytes, std::uint64_t word, int size) {
  for (int k = 0; k < size; ++k) bytes.push_back(static_cast<std::byte>(word >> 8 * k));
}

Bytes steered_body(std::initializer_list<double> numbers, std::uint32_t mark = 3) {
  Bytes bytes;
  append(bytes, mark, 4);
  for (const double number : numbers) append(bytes, std::bit_cast<std::uint64_t>(number), 8);
  return bytes;
}

SteeredMotion steered_one() {
  SteeredMotion motion =
      SteeredMotion::create({.start = {{{1, 2, 3}, {4, 5, 6}}}, .acceleration_limits = {9}}).value();
  motion.steer(0, 2.0, {0, 0, -9}).value();
  return motion;
}

TEST(WrittenBodies, HaveTheSameOrderOnAllMachines) {
  const SteeredMotion motion = steered_one();
  const double limit = motion.definition(0, 2.0).acceleration_limit;
  EXPECT_EQ(bytes_of(motion, 0), steered_body({2, 9, 12, 15, 4, 5, 6, limit, 0, 0, -9}));
}

TEST(WrittenBodies, AreRefusedWithTheReason) {
  SteeredMotion motion = steered_one();
  const auto refusal = [&](const Bytes& bytes) {
    std::span<const std::byte> rest = bytes;
    const auto read = motion.read_body(rest);
    EXPECT_EQ(motion.size(), 1u);
    EXPECT_EQ(read.error().code, ErrorCode::bad_bytes);
    return read.error().message;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal({}), "read_body: bytes must hold a whole body, but end before it does");
  EXPECT_EQ(refusal(steered_body({2, 9, 12})),
            "read_body: bytes must hold a whole body, but end before it does");
  EXPECT_EQ(refusal(steered_body({2, 9, 12}, 1)),
            "read_body: bytes must begin with 3, the mark of a body of SteeredMotion, but begin with 1");
  const std::string start = "read_body: bytes hold no body of this motion: ";
  EXPECT_EQ(refusal(steered_body({2, 9, nan, 15, 4, 5, 6, 9, 0, 0, 0})),
            start + "add: state, position, must be finite, but is (9, nan, 15)");
  EXPECT_EQ(refusal(steered_body({2, 9, 12, 15, 4, 5, 6, 9, 0, 0, -10})),
            start + "SteeredMotion: acceleration must not be longer than 9, but is (0, 0, -10)");
  EXPECT_EQ(refusal(steered_body({2, 9, 12, 15, 4, 5, 6, nan, 0, 0, 0})).substr(0, start.size()), start);
}

TEST(WrittenBodies, OfAFrameAreReadInThatFrame) {
  Random random(1);
  const Pair motions = frames(random);
  auto& there = dynamic_cast<FrameMotion&>(*motions.there);
  const Bytes bytes = bytes_of(*motions.here, 0);
  there.push({}).value();
  std::span<const std::byte> rest = bytes;
  EXPECT_EQ(
      there.read_body(rest).error().message,
      "read_body: bytes hold no body of this motion: FrameMotion: frame must be the latest one here, 1, but "
      "is 0");
}

/// The forces depend on the name under which a body began, wherever it is: also if another body has its
/// number.
TEST(WrittenBodies, KeepTheNameOfTheirForces) {
  Random random(1);
  const Pair motions = random_forces(random);
  const std::uint32_t first = read(*motions.there, bytes_of(*motions.here, 4));
  const std::uint32_t second = read(*motions.there, bytes_of(*motions.here, 2));
  EXPECT_EQ(first, 0u);
  EXPECT_EQ(second, 1u);
  const auto force = [](const Motion& motion, std::uint32_t body) {
    return motion.trajectory(body, 8.0, 8.0).front().acceleration;
  };
  EXPECT_EQ(force(*motions.there, first), force(*motions.here, 4));
  EXPECT_NE(force(*motions.there, first), force(*motions.here, 0));
  motions.there->remove(first).value();
  const auto added =
      dynamic_cast<RandomForces&>(*motions.there).add(6.0, motions.here->state(0, 6.0), 5.0).value();
  EXPECT_EQ(added, first);
  const Vec3 direction = force(*motions.there, added) / 5.0;
  const Vec3 expected = force(*motions.here, 0) / motions.here->definition(0, 8.0).acceleration_limit;
  EXPECT_NEAR(norm(direction - expected), 0.0, 1e-12) << "its own number is its name again";
}

TEST(WrittenBodies, AreUnsupportedUnlessAMotionHasThem) {
  Still motion;
  Bytes bytes;
  EXPECT_EQ(motion.write_body(0, bytes).error().code, ErrorCode::unsupported);
  EXPECT_EQ(motion.write_body(1, bytes).error().code, ErrorCode::unknown_body);
  std::span<const std::byte> rest = bytes;
  EXPECT_EQ(motion.read_body(rest).error().code, ErrorCode::unsupported);
  EXPECT_EQ(motion.read_body(rest).error().argument, "bytes");
}

}  // namespace
}  // namespace kinesphere::body_bytes_test
