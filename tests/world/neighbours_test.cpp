// Lists of neighbours do what a plain table of pairs does, and lists that cannot be are told apart.
#include "world/neighbours.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "archive/archive.hpp"
#include "archive/heap_counter.hpp"
#include "kinesphere/random.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

using Lists = std::vector<std::vector<Neighbour>>;

/// Every pair once, the lesser body first, with who watches it and until when.
class Table {
 public:
  struct Watch {
    std::uint32_t watcher = 0;
    double time = infinity;
  };

  void replace(std::uint32_t body, const std::vector<std::uint32_t>& found) {
    const std::set<std::uint32_t> wanted(found.begin(), found.end());
    std::erase_if(pairs_, [&](const auto& entry) {
      const auto& [a, b] = entry.first;
      return (a == body && !wanted.contains(b)) || (b == body && !wanted.contains(a));
    });
    for (const std::uint32_t partner : wanted) pairs_.try_emplace(std::minmax(body, partner));
  }
  bool contains(std::uint32_t a, std::uint32_t b) const { return pairs_.contains(std::minmax(a, b)); }
  Watch& at(std::uint32_t a, std::uint32_t b) { return pairs_.at(std::minmax(a, b)); }
  std::set<std::uint32_t> of(std::uint32_t body) const {
    std::set<std::uint32_t> partners;
    for (const auto& [pair, watch] : pairs_) {
      if (pair.first == body) partners.insert(pair.second);
      if (pair.second == body) partners.insert(pair.first);
    }
    return partners;
  }

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, Watch> pairs_;
};

enum class Kind { make_room, replace, remove_all, watch, unwatch, unwatch_all, archive };

struct Action {
  Kind kind = Kind::replace;
  std::uint32_t body = 0;
  std::vector<std::uint32_t> others;  ///< with repetitions; only the first counts for one pair
  int time = 0;
};

void showValue(const Action& action, std::ostream& out) {
  out << "kind " << static_cast<int>(action.kind) << ", body " << action.body << ", time " << action.time
      << ", others";
  for (const std::uint32_t other : action.others) out << " " << other;
}

constexpr std::uint32_t most_bodies = 12;

rc::Gen<Action> any_action() {
  const auto body = rc::gen::inRange<std::uint32_t>(0, most_bodies);
  // Half of them change who is near whom.
  const auto kind = rc::gen::weightedElement<Kind>({{1, Kind::make_room},
                                                    {8, Kind::replace},
                                                    {1, Kind::remove_all},
                                                    {6, Kind::watch},
                                                    {2, Kind::unwatch},
                                                    {1, Kind::unwatch_all},
                                                    {1, Kind::archive}});
  return rc::gen::build<Action>(
      rc::gen::set(&Action::kind, kind), rc::gen::set(&Action::body, body),
      rc::gen::set(&Action::others, rc::gen::container<std::vector<std::uint32_t>>(body)),
      rc::gen::set(&Action::time, rc::gen::inRange(-3, 100)));
}

Neighbours read_back(const auto& written) {
  ByteWriter writer;
  writer(written);
  ByteReader reader(writer.bytes());
  Neighbours neighbours;
  reader(neighbours);
  return neighbours;
}

/// Both, side by side.
struct Mirrored {
  std::uint32_t count = 3;
  Neighbours neighbours;
  Table table;

  Mirrored() { neighbours.make_room(count); }

  void act(Action action) {
    action.body %= count;
    for (std::uint32_t& other : action.others) other %= count;
    std::erase(action.others, action.body);
    switch (action.kind) {
      case Kind::make_room:
        neighbours.make_room(count = std::min(count + 1, most_bodies));
        break;
      case Kind::replace:
        neighbours.replace(action.body, action.others);
        table.replace(action.body, action.others);
        break;
      case Kind::remove_all:
        neighbours.remove_all(action.body);
        table.replace(action.body, {});
        break;
      case Kind::watch:
      case Kind::unwatch:
        change_watch(action);
        break;
      case Kind::unwatch_all:
        neighbours.unwatch_all(action.body);
        for (const std::uint32_t partner : table.of(action.body)) table.at(action.body, partner) = {};
        break;
      case Kind::archive:
        neighbours = read_back(neighbours);
        break;
    }
  }
  void change_watch(const Action& action) {
    for (const std::uint32_t partner : action.others) {
      const auto place = neighbours.find(action.body, partner);
      if (!place) continue;
      if (action.kind == Kind::watch) {
        neighbours.watch(action.body, *place, action.time);
        table.at(action.body, partner) = {action.body, static_cast<double>(action.time)};
      } else {
        neighbours.unwatch(action.body, *place);
        table.at(action.body, partner) = {};
      }
      return;
    }
  }

  void compare() {
    RC_ASSERT(neighbours.is_sound(count));
    RC_ASSERT(!neighbours.is_sound(count + 1));
    for (std::uint32_t body = 0; body < count; ++body) {
      RC_ASSERT(neighbours.of(body).size() == table.of(body).size());
      for (std::uint32_t partner = 0; partner < count; ++partner) {
        const auto place = neighbours.find(body, partner);
        RC_ASSERT(place.has_value() == table.contains(body, partner));
        if (place) compare(body, partner, *place);
      }
    }
  }
  void compare(std::uint32_t body, std::uint32_t partner, Neighbours::Place place) {
    const Neighbour& side = neighbours.of(body)[place];
    const auto [watcher, time] = table.at(body, partner);
    RC_ASSERT(side.partner == partner);
    const double by_partner = time < infinity ? Neighbour::partner_does : Neighbour::nobody;
    RC_ASSERT(side.watch == (watcher == body ? time : by_partner));
    RC_ASSERT(side.watches() == (watcher == body && time < infinity));
    RC_ASSERT(side.is_watched(time - 1.0) == (time < infinity));
    RC_ASSERT(side.is_watched(time) == (time < infinity && watcher != body));
    RC_ASSERT(neighbours.watched_until(body, place) == time);
  }
};

RC_GTEST_PROP(NeighboursProperty, do_what_a_table_of_pairs_does, ()) {
  const auto actions = *rc::gen::scale(4.0, rc::gen::container<std::vector<Action>>(any_action()));
  Mirrored mirrored;
  for (const Action& action : actions) {
    mirrored.act(action);
    mirrored.compare();
  }
}

void watch(Neighbours& neighbours, std::uint32_t body, std::uint32_t partner, double time) {
  const auto place = neighbours.find(body, partner);
  ASSERT_TRUE(place);
  neighbours.watch(body, *place, time);
}

double watched_until(const Neighbours& neighbours, std::uint32_t body, std::uint32_t partner) {
  return neighbours.watched_until(body, neighbours.find(body, partner).value());
}

TEST(Neighbours, that_stay_keep_their_watches_and_the_others_lose_them) {
  Neighbours neighbours;
  neighbours.make_room(5);
  neighbours.replace(0, std::vector<std::uint32_t>{1, 2, 3});
  watch(neighbours, 0, 1, 4.0);
  watch(neighbours, 2, 0, 5.0);
  watch(neighbours, 0, 3, 6.0);
  neighbours.replace(0, std::vector<std::uint32_t>{4, 2, 3, 2});
  EXPECT_FALSE(neighbours.find(0, 1));
  EXPECT_TRUE(neighbours.of(1).empty());
  EXPECT_EQ(watched_until(neighbours, 0, 2), 5.0);
  EXPECT_EQ(neighbours.of(2).front().watch, 5.0);
  EXPECT_EQ(watched_until(neighbours, 3, 0), 6.0);
  EXPECT_EQ(watched_until(neighbours, 0, 4), infinity);
  neighbours.replace(0, std::vector<std::uint32_t>{1});
  EXPECT_EQ(watched_until(neighbours, 0, 1), infinity);
}

TEST(Neighbours, are_watched_from_the_side_that_was_last) {
  Neighbours neighbours;
  neighbours.make_room(2);
  neighbours.replace(1, std::vector<std::uint32_t>{0});
  watch(neighbours, 0, 1, 3.0);
  watch(neighbours, 1, 0, 8.0);
  EXPECT_EQ(watched_until(neighbours, 0, 1), 8.0);
  EXPECT_EQ(neighbours.of(0).front().watch, Neighbour::partner_does);
  neighbours.unwatch(0, 0);
  EXPECT_EQ(watched_until(neighbours, 1, 0), infinity);
}

/// Each new body is near all that came before it. A list that moves is copied; when the whole table moves, so
/// does each list in it.
TEST(Neighbours, in_long_lists_are_seldom_moved) {
  constexpr std::uint32_t bodies = 600;
  Neighbours neighbours;
  neighbours.make_room(bodies);
  std::vector<std::uint32_t> near;
  int moves = 0;
  const Neighbour* before = nullptr;
  for (std::uint32_t body = 0; body < bodies; ++body) {
    neighbours.replace(body, near);
    near.push_back(body);
    moves += neighbours.of(0).data() != before;
    before = neighbours.of(0).data();
  }
  EXPECT_TRUE(neighbours.is_sound(bodies));
  EXPECT_LT(moves, 100);
  EXPECT_LT(heap_bytes(neighbours), std::size_t{2} * bodies * bodies * sizeof(Neighbour));
}

/// What long lists leave behind when they move serves others.
TEST(Neighbours, that_come_and_go_take_no_more_memory) {
  constexpr std::uint32_t bodies = 400;
  Neighbours neighbours;
  neighbours.make_room(bodies);
  std::vector<std::uint32_t> all;
  for (std::uint32_t body = 0; body < bodies; ++body) all.push_back(body);
  Random random(5);
  std::size_t most = 0;
  for (int round = 0; round < 2000; ++round) {
    const auto body = static_cast<std::uint32_t>(random.bits() % bodies);
    std::vector<std::uint32_t> found;
    const double part = random.uniform();
    for (const std::uint32_t other : all)
      if (other != body && random.uniform() < part) found.push_back(other);
    neighbours.replace(body, found);
    most = std::max(most, heap_bytes(neighbours));
  }
  EXPECT_TRUE(neighbours.is_sound(bodies));
  EXPECT_LT(most, std::size_t{2} * bodies * bodies * sizeof(Neighbour));
}

/// 0 - 1, 0 - 2, 1 - 2, and 3 alone; 0 watches 1.
Lists sound_lists() {
  return {{{.watch = 1.0, .partner = 1, .mirror = 0}, {.partner = 2, .mirror = 0}},
          {{.watch = Neighbour::partner_does, .partner = 0, .mirror = 0}, {.partner = 2, .mirror = 1}},
          {{.partner = 0, .mirror = 1}, {.partner = 1, .mirror = 1}},
          {}};
}

TEST(Neighbours, that_are_read_are_sound_only_if_both_sides_agree) {
  ASSERT_TRUE(read_back(sound_lists()).is_sound(4));
  EXPECT_FALSE(read_back(sound_lists()).is_sound(3));
  EXPECT_FALSE(read_back(sound_lists()).is_sound(5));
  EXPECT_TRUE(read_back(Lists{}).is_sound(0));

  const std::vector<std::pair<const char*, void (*)(Lists&)>> mistakes{
      {"a watch that is no number", [](Lists& lists) { lists[2][0].watch = std::nan(""); }},
      {"both sides watch", [](Lists& lists) { lists[1][0].watch = 2.0; }},
      {"one watches unknown to the other", [](Lists& lists) { lists[1][0].watch = Neighbour::nobody; }},
      {"both leave it to the other", [](Lists& lists) { lists[0][0].watch = Neighbour::partner_does; }},
      {"one leaves it to a partner who does not",
       [](Lists& lists) { lists[2][0].watch = Neighbour::partner_does; }},
      {"a partner that is not there", [](Lists& lists) { lists[0][1].partner = 4; }},
      {"another partner", [](Lists& lists) { lists[0][1].partner = 3; }},
      {"a place beyond the end", [](Lists& lists) { lists[0][1].mirror = 2; }},
      {"another place", [](Lists& lists) { lists[0][1].mirror = 1; }},
      {"one side is missing", [](Lists& lists) { lists[2].pop_back(); }},
      {"a body beside itself", [](Lists& lists) { lists[3].push_back({.partner = 3, .mirror = 0}); }},
      {"a pair that is there twice",
       [](Lists& lists) {
         lists[0].push_back({.partner = 2, .mirror = 2});
         lists[2].push_back({.partner = 0, .mirror = 2});
       }},
      {"three in a ring, each beside the next",
       [](Lists& lists) {
         lists = {{{.partner = 1}}, {{.partner = 2}}, {{.partner = 0}}, {}};
       }},
      {"mirrors crossed within a pair that is there twice",
       [](Lists& lists) {
         lists[0].push_back({.partner = 2, .mirror = 0});
         lists[2].push_back({.partner = 0, .mirror = 1});
       }},
  };
  for (const auto& [name, make] : mistakes) {
    Lists lists = sound_lists();
    make(lists);
    EXPECT_FALSE(read_back(lists).is_sound(4)) << name;
  }
}

}  // namespace
}  // namespace kinesphere
