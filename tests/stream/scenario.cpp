#include "stream/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

#include "kinesphere/limits.hpp"
#include "kinesphere/random.hpp"

namespace kinesphere::stream {
namespace {

/// How often a feature is drawn: in one of this many scenarios.
struct DrawnFeature : Feature {
  unsigned one_in;
};
constexpr DrawnFeature drawn_features[] = {
    {{"box", &Scenario::box}, 1},
    {{"periodic", &Scenario::periodic}, 3},
    {{"flat", &Scenario::flat}, 5},
    {{"line", &Scenario::line}, 12},
    {{"far", &Scenario::far}, 3},
    {{"late", &Scenario::late}, 3},
    {{"scaled", &Scenario::scaled}, 2},
    {{"errors", &Scenario::errors}, 4},
    {{"zeno", &Scenario::zeno}, 3},
    {{"spread", &Scenario::spread}, 2},
    {{"wall_filter", &Scenario::wall_filter}, 6},
    {{"filters", &Scenario::filters}, 3},
    {{"mixed_contacts", &Scenario::mixed_contacts}, 4},
    {{"sizes", &Scenario::sizes}, 5},
    {{"fast", &Scenario::fast}, 5},
    {{"steered", &Scenario::steered}, 1},
    {{"gravity", &Scenario::gravity}, 4},
    {{"bounces", &Scenario::bounces}, 2},
    {{"settles", &Scenario::settles}, 4},
    {{"losses", &Scenario::losses}, 2},
    {{"radii", &Scenario::radii}, 2},
    {{"rigid", &Scenario::rigid}, 2},
    {{"hulls", &Scenario::hulls}, 2},
    {{"spins", &Scenario::spins}, 3},
    {{"carried", &Scenario::carried}, 3},
    {{"statics", &Scenario::statics}, 2},
    {{"zones", &Scenario::zones}, 3},
    {{"sensors", &Scenario::sensors}, 3},
    {{"actions", &Scenario::actions}, 3},
    {{"resting", &Scenario::resting}, 3},
    {{"recorded", &Scenario::recorded}, 4},
    {{"copies", &Scenario::copies}, 1},
    {{"answers", &Scenario::answers}, 1},
    {{"overlaps", &Scenario::overlaps}, 2},
    {{"grid", &Scenario::grid}, 3},
    {{"pair_filter", &Scenario::pair_filter}, 6},
    {{"runs", &Scenario::runs}, 1},
};
constexpr auto plain_features = [] {
  std::array<Feature, std::size(drawn_features)> all{};
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = drawn_features[k];
  return all;
}();

}  // namespace

std::span<const Feature> features() { return plain_features; }

Scenario draw_scenario(std::uint64_t seed) {
  Random random(seed);
  const auto draw = [&](const auto& all) { return all[random.bits() % std::size(all)]; };
  const auto one_in = [&](unsigned count) { return random.bits() % count == 0; };
  Scenario scenario{.seed = seed};
  scenario.bodies = 6 + static_cast<int>(random.bits() % 14);
  if (one_in(4)) scenario.bodies += 12;
  scenario.edge = random.uniform(2.5, 6.0);
  scenario.relative_tolerance = draw(std::array{1e-3, 1e-4, 1e-6, 1e-6, 1e-9});
  scenario.contacts =
      draw(std::array{ContactEvents::all, ContactEvents::begin_and_end, ContactEvents::impacts});
  constexpr std::array scales{1.0, 1.0, 1e-3, 1e3, 1e-9, 1e9, 1e-20, 1e15};
  scenario.length_scale = draw(scales);
  scenario.time_scale = draw(scales);
  scenario.restitution = random.uniform(0.3, 1.0);
  scenario.remoteness = random.unit_vector();
  scenario.remoteness *= one_in(2) ? 0.5 : 1e-3 * random.uniform();
  scenario.lateness = one_in(2) ? 1.0 : -1.0;
  scenario.error_scale = one_in(2) ? 0.1 : 5.0;
  for (const DrawnFeature& feature : drawn_features) scenario.*feature.is_on = one_in(feature.one_in);
  scenario.box = scenario.periodic || !one_in(3);
  scenario.steered = !one_in(4);
  scenario.repeats = {one_in(2), one_in(2), one_in(2) && !scenario.flat};
  scenario.clear_contradictions();
  return scenario;
}

void Scenario::clear_contradictions() {
  if (!box) periodic = wall_filter = false;
  if (!bounces) settles = losses = false;
  if (!gravity) settles = false;
  if (!rigid) hulls = spins = false;
  if (periodic) carried = false;
  if (overlaps && rigid) relative_tolerance = std::max(relative_tolerance, 1e-4);
  // A copy is not recorded, and neither is a change of the answers of a pair filter.
  if (recorded) copies = pair_filter = false;
}

void Scenario::make_crowd() {
  bodies = 90 + static_cast<int>(seed % 60);
  crowd = runs = true;
  rigid = carried = resting = pair_filter = recorded = sizes = answers = overlaps = false;
  clear_contradictions();
}

Vec3 Scenario::origin() const {
  if (!far) return {};
  Vec3 corner = remoteness * (limits::largest_length * tolerance() - 40.0 * unit_length());
  if (flat) corner.z = 0.0;
  return corner;
}

WorldDefinition Scenario::definition() const {
  WorldDefinition world{.dimensions = flat ? 2 : 3,
                        .contact_tolerance = tolerance(),
                        .contacts = contacts,
                        .allow_overlap = overlaps,
                        .zeno_interval = zeno ? 0.02 * unit_time() : 0.0,
                        .spread_window_starts = spread};
  if (box) world.box = Box{origin(), origin() + Vec3{1.0, 1.2, flat ? 0.0 : 0.9} * (edge * unit_length())};
  if (is_periodic()) world.periodic = repeats;
  if (wall_filter) world.wall_filter = Filter{.category = 1, .mask = 3};
  if (errors) world.separation_distance = 8.0 * position_error() + 4.0 * tolerance();
  if (late) {
    // In a unit in the last place of a time, bodies move by 1e-4 tolerances.
    const double speed = (fast ? 400.0 : 4.0) * unit_length() / unit_time();
    world.start_time = lateness * std::min(1e-4 * tolerance() / speed * 0x1p53, 1e6 * unit_time());
  }
  return world;
}

std::string Scenario::text() const {
  std::ostringstream text;
  text << "seed " << seed << ", " << bodies << " bodies, edge " << edge << ", relative tolerance "
       << relative_tolerance << ", contacts " << static_cast<int>(contacts);
  if (crowd) text << ", a crowd";
  if (scaled) text << ", length scale " << length_scale << ", time scale " << time_scale;
  text << ", with";
  for (const Feature& feature : features())
    if (this->*feature.is_on) text << " " << feature.name;
  return text.str();
}

}  // namespace kinesphere::stream
