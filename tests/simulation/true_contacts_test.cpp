// The truth is the same whether every pair is followed all the time or only while its bodies may be near, and
// the same as the oracle's, which knows nothing of spans.
#include "simulation/oracle/true_contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <memory>
#include <utility>

#include "kinesphere/motion/recorded_tracks.hpp"
#include "kinesphere/random.hpp"
#include "simulation/oracle/comparison.hpp"
#include "simulation/oracle/oracle.hpp"
#include "support/differential_scenes.hpp"

namespace kinesphere::true_contacts_test {
namespace {

using scene_tests::differential_scene;
using scene_tests::Family;

using Pair = std::pair<std::uint32_t, std::uint32_t>;
using Spans = std::map<Pair, std::vector<NearSpan>>;

constexpr std::uint64_t seeds = 8;

template <class Check>
void for_each_scene(const Check& check) {
  for (int index = 0; index < static_cast<int>(Family::count); ++index)
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      SCOPED_TRACE(std::string(name_of(Family{index})) + " " + std::to_string(seed));
      check(differential_scene(Family{index}, seed));
    }
}

Spans spans_by_pair(const TrueMotion& motion, double gap = 0.0) {
  Spans spans;
  for (const NearSpan& span : near_spans(motion.bodies(), gap))
    spans[{span.first, span.second}].push_back(span);
  return spans;
}

std::vector<NearSpan> found(const Spans& spans, const Pair& pair) {
  const auto at = spans.find(pair);
  return at == spans.end() ? std::vector<NearSpan>() : at->second;
}

template <class Visit>
void for_each_pair(const TrueMotion& motion, const Visit& visit) {
  const auto count = static_cast<std::uint32_t>(motion.bodies().size());
  for (std::uint32_t a = 0; a < count; ++a)
    for (std::uint32_t b = a + 1; b < count; ++b)
      if (motion.bodies()[a].trajectory != nullptr && motion.bodies()[b].trajectory != nullptr) visit(a, b);
}

TEST(TrueContacts, are_the_same_to_the_last_bit_in_spans_and_all_the_time) {
  std::size_t contacts = 0;
  for_each_scene([&](const Scene& scene) {
    const TrueMotion motion(scene);
    const Spans spans = spans_by_pair(motion);
    for_each_pair(motion, [&](std::uint32_t a, std::uint32_t b) {
      const GapCourse gap = motion.pair(a, b);
      const auto everywhere = motion.contacts(gap, a, b, {motion.whole_span(a, b)});
      const auto near = motion.contacts(gap, a, b, found(spans, {a, b}));
      EXPECT_EQ(near, everywhere) << a << " " << b;
      contacts += near.size();
    });
  });
  EXPECT_GT(contacts, 200u);
}

/// As the oracle counts: a contact that lasts has no end.
std::map<Pair, std::vector<ContactInterval>> told_by_oracle(const Scene& scene) {
  std::map<Pair, std::vector<ContactInterval>> contacts;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) {
    if (event.already_touching) return;
    auto& of_pair = contacts[std::minmax(event.first.index, event.second.index)];
    if (event.kind == EventKind::contact_begin) of_pair.push_back({.begin = event.time});
    if (event.kind == EventKind::contact_end) of_pair.back().end = event.time;
  };
  EXPECT_TRUE(run_scene(scene, make_oracle, observer));
  return contacts;
}

TEST(TrueContacts, are_those_of_the_oracle) {
  for_each_scene([](const Scene& scene) {
    const auto oracle = told_by_oracle(scene);
    const TrueMotion motion(scene);
    const Spans spans = spans_by_pair(motion);
    for_each_pair(motion, [&](std::uint32_t a, std::uint32_t b) {
      const auto reported = oracle.find({a, b});
      const auto true_ones = motion.contacts(motion.pair(a, b), a, b, found(spans, {a, b}));
      ASSERT_EQ(true_ones.size(), reported == oracle.end() ? 0 : reported->second.size()) << a << " " << b;
      for (std::size_t k = 0; k < true_ones.size(); ++k) {
        // A grazing gap hardly changes: rounding at the start of a search shifts where it is found.
        EXPECT_NEAR(true_ones[k].begin, reported->second[k].begin, 1e-6) << a << " " << b;
        if (true_ones[k].end == infinity || reported->second[k].end == infinity)
          EXPECT_EQ(true_ones[k].end, reported->second[k].end) << a << " " << b;
        else
          EXPECT_NEAR(true_ones[k].end, reported->second[k].end, 1e-6) << a << " " << b;
      }
    });
  });
}

/// Looked at in small steps.
TEST(NearSpans, hold_all_times_at_which_two_are_as_near_as_that) {
  for_each_scene([](const Scene& scene) {
    const TrueMotion motion(scene);
    for (const double gap : {0.0, 0.5}) {
      const Spans spans = spans_by_pair(motion, gap);
      for_each_pair(motion, [&](std::uint32_t a, std::uint32_t b) {
        const double first = motion.first_time(a, b), last = motion.last_time(a, b);
        if (first > last) return;
        const auto of_pair = found(spans, {a, b});
        const GapCourse course = motion.pair(a, b);
        for (int step = 0; step <= 50; ++step) {
          const double time = std::min(last, first + (last - first) * step / 50);
          if (course.gap_at(time) > gap) continue;
          EXPECT_TRUE(
              std::any_of(of_pair.begin(), of_pair.end(),
                          [&](const NearSpan& span) { return span.begin <= time && time <= span.end; }))
              << a << " " << b << " at " << time;
        }
      });
    }
  });
}

TEST(NearSpans, are_sorted_and_apart_and_within_the_time_of_both) {
  for_each_scene([](const Scene& scene) {
    const TrueMotion motion(scene);
    for (const auto& [pair, spans] : spans_by_pair(motion, 0.1)) {
      const auto [a, b] = pair;
      EXPECT_LT(a, b);
      double before = -infinity;
      for (const NearSpan& span : spans) {
        EXPECT_LE(span.begin, span.end);
        EXPECT_LT(before, span.begin);
        EXPECT_LE(motion.first_time(a, b), span.begin);
        EXPECT_LE(span.end, motion.last_time(a, b));
        before = span.end;
      }
    }
  });
}

TEST(NearSpans, of_nobody_are_none) {
  EXPECT_TRUE(near_spans({}, 1.0).empty());
  EXPECT_TRUE(near_spans({{}, {}}, 1.0).empty());
}

/// The box of a piece that swings out beyond its ends.
TEST(NearSpans, box_holds_the_whole_curve) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    std::vector<TrackSample> samples;
    for (int sample = 0; sample < 5; ++sample)
      samples.push_back({sample + 0.8 * random.uniform(), 100.0 * random.point_in_ball()});
    const auto motion = RecordedTracks::create({samples}).value();
    const double begin = random.uniform(0.0, 4.0), end = begin + random.uniform(0.0, 3.0);
    const Box box = box_of(motion.trajectory(0, begin, end), begin, end);
    for (int step = 0; step <= 100; ++step) {
      const Vec3 at = motion.state(0, std::min(end, begin + (end - begin) * step / 100)).position;
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(box.lower[axis], at[axis]);
        EXPECT_LE(at[axis], box.upper[axis]);
      }
    }
  }
}

/// Thousands of short tracks, each of which comes and goes at a time of its own, along a long road.
Scene many_short_tracks(std::uint32_t count) {
  std::vector<Track> tracks;
  Scene scene;
  scene.world.contacts = ContactEvents::begin_and_end;
  for (std::uint32_t k = 0; k < count; ++k) {
    Random random = Random::at(7, 0, k);
    const double start = 0.5 * k;
    Vec3 position{random.uniform(0.0, 200.0), random.uniform(0.0, 200.0), 0.0};
    Track track;
    for (int sample = 0; sample < 20; ++sample) {
      track.push_back({start + sample, position});
      position += random.point_in_ball();
    }
    scene.bodies.push_back({.radius = 1.0, .appears = start, .vanishes = start + 19.0});
    tracks.push_back(std::move(track));
  }
  scene.end_time = 0.5 * count + 20.0;
  scene.motion = std::make_unique<RecordedTracks>(RecordedTracks::create(tracks).value());
  return scene;
}

TEST(Comparison, of_many_short_tracks_takes_no_time_for_each_pair) {
  const Scene scene = many_short_tracks(4000);
  std::vector<Event> events;
  SceneObserver observer;
  observer.on_event = [&](const Event& event) {
    if (!event.already_touching) events.push_back(event);
  };
  ASSERT_TRUE(run_scene(scene, make_world_detector, observer));
  EXPECT_GT(events.size(), 100u);
  const std::clock_t begin = std::clock();
  const ContactComparison comparison = compare_with_oracle(scene, events).value();
  // Seconds; a hundredth of one is usual, a look at every pair whenever a track ends takes minutes.
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 10.0);
  EXPECT_TRUE(comparison.agrees()) << comparison.first_difference.value_or("");
  EXPECT_EQ(comparison.matched, events.size());
}

TEST(Comparison, tells_how_far_it_has_come) {
  const Scene scene = many_short_tracks(100);
  double done = 0.0;
  const auto comparison = compare_with_oracle(scene, {}, [&](double part) {
    EXPECT_LE(done, part);
    EXPECT_LE(part, 1.0);
    done = part;
  });
  ASSERT_TRUE(comparison);
  EXPECT_GT(done, 0.3);
}

/// What nobody did stands out, also of bodies that are never near, or never there.
TEST(Comparison, notices_contacts_of_bodies_that_are_far_from_each_other) {
  Scene scene = many_short_tracks(3);
  scene.bodies[2].appears = scene.end_time + 1.0;
  scene.bodies[2].vanishes = scene.end_time + 2.0;
  for (const std::uint32_t partner : {1u, 2u, 7u}) {
    Event event{};
    event.kind = EventKind::contact_begin;
    event.time = 1.0;
    event.first = {0, 0};
    event.second = {partner, 0};
    const ContactComparison comparison = compare_with_oracle(scene, {event}).value();
    EXPECT_FALSE(comparison.agrees()) << partner;
    EXPECT_GE(comparison.invented, 1u) << partner;
  }
}

}  // namespace
}  // namespace kinesphere::true_contacts_test
