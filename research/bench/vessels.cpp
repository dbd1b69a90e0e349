#include "research/bench/vessels.hpp"

#include <fmt/format.h>
#include <CLI/App.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "base/output_file.hpp"
#include "base/program_error.hpp"
#include "base/validators.hpp"
#include "kinesphere/random.hpp"
#include "research/bench/commands.hpp"

namespace kinesphere::program {
namespace {

/// Independent streams of random numbers, one for each thing that is drawn.
enum Stream : std::uint64_t { harbour_stream, vessel_stream, report_stream };

constexpr double earth_radius = 6'371'000.0;
constexpr std::uint32_t harbour_count = 40;
constexpr double coast_length = 900'000.0;
constexpr double coast_depth = 40'000.0;
constexpr double berth_width = 30.0, pier_distance = 60.0;
constexpr double receiver_noise = 1.5;    ///< largest error of a reported coordinate (length)
constexpr double still_interval = 210.0;  ///< time between two reports of a vessel that lies still
constexpr double moving_interval = 74.0;  ///< time between two reports of a vessel that moves
constexpr double lost_part = 0.04;        ///< part of all reports

/// A place on the plane that touches the earth in the middle of the coast.
struct Place {
  double x = 0.0, y = 0.0;
};

Place operator+(Place a, Place b) { return {a.x + b.x, a.y + b.y}; }
Place operator-(Place a, Place b) { return {a.x - b.x, a.y - b.y}; }
Place operator*(double f, Place p) { return {f * p.x, f * p.y}; }
double length(Place p) { return std::sqrt(p.x * p.x + p.y * p.y); }

/// Returns the place on the earth, by functions that give the same bits on every machine.
Vec3 on_earth(Place p) {
  const double scale = earth_radius / std::sqrt(earth_radius * earth_radius + p.x * p.x + p.y * p.y);
  const auto rounded = [](double metres) { return std::round(100.0 * metres) / 100.0; };
  // The coast is at 45 degrees North.
  const double up = std::sqrt(0.5) * scale;
  return {rounded(up * (earth_radius - p.y)), rounded(scale * p.x), rounded(up * (earth_radius + p.y))};
}

/// Goes from -1 to 1 and back while `phase` goes from a whole number to the next, slower at each end.
double swing(double phase) {
  const double part = phase - std::floor(phase);
  const double there_and_back = part < 0.5 ? 4.0 * part - 1.0 : 3.0 - 4.0 * part;
  return there_and_back * (1.5 - 0.5 * there_and_back * there_and_back);
}

Place any_direction(Random& random) {
  const Vec3 unit = random.unit_vector();
  const double norm = std::sqrt(unit.x * unit.x + unit.y * unit.y);
  return norm > 0.0 ? (1.0 / norm) * Place{unit.x, unit.y} : Place{1.0, 0.0};
}

/// A course from one end to the other and back, with a swing across that way.
struct Course {
  Place middle{}, half_way{}, half_swing{};
  double period = 1.0, swing_period = 1.0;
  double phase = 0.0, swing_phase = 0.0;
  double interval = moving_interval;  ///< time between two reports
  Place elsewhere{};  ///< place of another vessel that reports under this id, every other time
  bool shared = false;

  Place at(double t) const {
    return middle + swing(t / period + phase) * half_way + swing(t / swing_period + swing_phase) * half_swing;
  }
};

class Coast {
 public:
  explicit Coast(const VesselParameters& p) : p_(p) {
    for (std::uint32_t k = 0; k < harbour_count; ++k) {
      Random random = Random::at(p.seed, harbour_stream, k);
      harbours_.push_back(
          {random.uniform(-0.5, 0.5) * coast_length, random.uniform(-0.5, 0.5) * coast_depth});
    }
    berths_.resize(harbour_count, 0);
  }

  Course course(std::uint32_t vessel) {
    Random random = Random::at(p_.seed, vessel_stream, vessel);
    const double kind = random.uniform();
    const std::uint32_t harbour = busy_harbour(random);
    Course course = kind < 0.66   ? moored(harbour)
                    : kind < 0.76 ? at_anchor(harbour, random)
                    : kind < 0.90 ? ferry(harbour, random)
                    : kind < 0.99 ? coaster(harbour, random)
                                  : aircraft(harbour, random);
    course.phase = random.uniform();
    course.swing_phase = random.uniform();
    if (random.uniform() < 0.002) {
      course.shared = true;
      course.elsewhere = harbours_[busy_harbour(random)] - harbours_[harbour];
    }
    return course;
  }

 private:
  /// Chooses harbour k about as often as 1 / (k + 1): the largest has a quarter of all vessels.
  static std::uint32_t busy_harbour(Random& random) {
    const double u = random.uniform();
    return static_cast<std::uint32_t>(harbour_count * u * u * u);
  }

  /// Returns the next berth of the harbour, in rows along piers.
  Course moored(std::uint32_t harbour) {
    constexpr std::uint32_t row = 20;
    const std::uint32_t berth = berths_[harbour]++;
    const std::uint32_t pier = berth / row;
    const Place place{berth_width * (berth % row), pier_distance * pier};
    return {.middle = harbours_[harbour] + place, .interval = still_interval};
  }

  Course at_anchor(std::uint32_t harbour, Random& random) {
    const Place roads = harbours_[harbour] + random.uniform(1500.0, 6000.0) * any_direction(random);
    const Place wind = any_direction(random);
    const double chain = random.uniform(20.0, 80.0);
    return {.middle = roads,
            .half_way = chain * wind,
            .half_swing = 0.3 * chain * Place{-wind.y, wind.x},
            .period = random.uniform(600.0, 1800.0),
            .swing_period = random.uniform(400.0, 900.0),
            .interval = still_interval};
  }

  /// Returns a course past the piers, between two landings.
  Course ferry(std::uint32_t harbour, Random& random) {
    const Place from = harbours_[harbour] + random.uniform(0.0, 700.0) * any_direction(random);
    return sailing(from, from + random.uniform(500.0, 8000.0) * any_direction(random),
                   random.uniform(2.0, 12.0), random.uniform(0.0, 60.0), random);
  }

  Course coaster(std::uint32_t harbour, Random& random) {
    const Place from = harbours_[harbour] + random.uniform(1000.0, 3000.0) * any_direction(random);
    const Place to = harbours_[busy_harbour(random)] + random.uniform(2000.0, 5000.0) * any_direction(random);
    return sailing(from, to, random.uniform(4.0, 11.0), random.uniform(50.0, 400.0), random);
  }

  Course aircraft(std::uint32_t harbour, Random& random) {
    const Place base = harbours_[harbour] + random.uniform(0.0, 5000.0) * any_direction(random);
    return sailing(base, base + random.uniform(30'000.0, 120'000.0) * any_direction(random),
                   random.uniform(40.0, 120.0), random.uniform(500.0, 3000.0), random);
  }

  static Course sailing(Place from, Place to, double speed, double aside, Random& random) {
    const Place way = to - from;
    const double far = std::max(length(way), 100.0);
    return {.middle = 0.5 * (from + to),
            .half_way = 0.5 * way,
            .half_swing = aside / far * Place{-way.y, way.x},
            .period = 2.0 * far / speed,
            .swing_period = random.uniform(0.05, 0.2) * far / speed + 300.0};
  }

  const VesselParameters& p_;
  std::vector<Place> harbours_;
  std::vector<std::uint32_t> berths_;  ///< by harbour: berths taken
};

Track reports(const Course& course, double seconds, Random random) {
  Track track;
  const auto noise = [&] {
    return receiver_noise * Place{random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
  };
  double time = -course.interval * random.uniform();
  for (bool elsewhere = false;; elsewhere = !elsewhere) {
    const bool last = time >= seconds;
    const bool lost = !track.empty() && !last && random.uniform() < lost_part;
    if (!lost) {
      const Place there = course.shared && elsewhere ? course.elsewhere : Place{};
      const double whole = std::round(10.0 * time) / 10.0;
      track.push_back({whole, on_earth(course.at(time) + there + noise())});
    }
    if (last && track.back().time >= seconds) return track;
    time += course.interval * random.uniform(0.8, 1.2);
  }
}

}  // namespace

std::vector<Track> vessel_tracks(const VesselParameters& parameters) {
  Coast coast(parameters);
  std::vector<Track> tracks;
  for (std::uint32_t vessel = 0; vessel < parameters.vessels; ++vessel)
    tracks.push_back(reports(coast.course(vessel), parameters.seconds,
                             Random::at(parameters.seed, report_stream, vessel)));
  return tracks;
}

Scene make_vessels(const VesselParameters& parameters, double distance) {
  Scene scene;
  scene.name = "vessels";
  scene.world.contact_tolerance = 1e-6 * distance;
  scene.world.contacts = ContactEvents::begin_and_end;
  scene.end_time = parameters.seconds;
  scene.bodies.assign(parameters.vessels, {.radius = 0.5 * distance});
  scene.motion = std::make_unique<RecordedTracks>(require(RecordedTracks::create(vessel_tracks(parameters))));
  return scene;
}

namespace {

struct VesselOptions {
  std::string file;
  VesselParameters parameters;
};

int bench_vessels(const VesselOptions& options) {
  const std::vector<Track> tracks = vessel_tracks(options.parameters);
  struct Sighting {
    std::size_t vessel;
    const TrackSample* sample;
  };
  std::vector<Sighting> reports;
  for (std::size_t vessel = 0; vessel < tracks.size(); ++vessel)
    for (const TrackSample& sample : tracks[vessel]) reports.push_back({vessel, &sample});
  std::stable_sort(reports.begin(), reports.end(),
                   [](const Sighting& a, const Sighting& b) { return a.sample->time < b.sample->time; });
  OutputFile file(options.file);
  file.write("id,time,x,y,z\n");
  for (const auto& [vessel, sample] : reports)
    file.write(fmt::format("{},{:.1f},{:.2f},{:.2f},{:.2f}\n", 200'000'000 + vessel, sample->time,
                           sample->position.x, sample->position.y, sample->position.z));
  file.commit();
  fmt::print("{}: {} reports of {} vessels\n", options.file, reports.size(), tracks.size());
  return exit_fine;
}

}  // namespace

Command add_vessels(CLI::App& app) {
  const auto options = std::make_shared<VesselOptions>();
  CLI::App* const command =
      app.add_subcommand("vessels", "Write a table of vessels' reports, for `kinesphere tracks`");
  command->add_option("FILE", options->file, "Table to write, .csv")->required();
  command->add_option("--vessels", options->parameters.vessels, "How many")
      ->check(whole_number(1'000'000))
      ->capture_default_str();
  command->add_option("--seed", options->parameters.seed, "Of all random numbers")
      ->check(whole_number(std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  return {command, [options] { return bench_vessels(*options); }};
}

}  // namespace kinesphere::program
