#include "research/bench/speed/contest.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "base/program_error.hpp"
#include "research/bench/measurement.hpp"
#include "research/bench/speed/bullet_kernel.hpp"
#include "research/bench/speed/step_recording.hpp"
#include "research/bench/speed/transcript.hpp"
#include "research/bench/speed/tuning.hpp"

namespace kinesphere::program {
namespace {

/// CPU time (seconds) beyond which a detector takes only one turn against each group of rivals. Higher values
/// give slow detectors better medians and take longer.
constexpr double slow = 2.0;

class Contest {
 public:
  Contest(const SpeedScene& entry, const SpeedSettings& settings)
      : entry_(entry),
        settings_(settings),
        scene_(entry.make(entry.response)),
        world_(default_engine(entry.alarm > 0.0 ? alarm_engine(entry.alarm) : world_engine())) {
    if (!has_rivals()) return;
    passing_ = entry.make(SceneResponse::pass_through);
    // A detector with fixed steps sees alarms as contacts of larger bodies.
    for (SceneBody& body : passing_.bodies) body.radius += 0.5 * entry.alarm;
    truth_ = counted(count_contacts(passing_, world_engine().make));
  }

  std::vector<SpeedRow> run() {
    for (const double rate : entry_.rates)
      for (const SphereTest test : {SphereTest::at_steps, SphereTest::swept}) run_steps(rate, test);
    if (world_.row.turns.empty()) take_turns({});
    summarize(world_);
    rows_.insert(rows_.begin(), world_.row);
    return std::move(rows_);
  }

 private:
  struct Cost {
    double detection;                  ///< seconds for a body-second
    std::optional<double> building{};  ///< seconds
  };

  struct Contestant {
    SpeedRow row;
    std::function<Cost()> run;
    bool is_slow = false;
    std::vector<double> building{};  ///< by run
  };

  bool has_rivals() const { return !entry_.rates.empty(); }
  /// Returns the scene that fixed steps are timed on.
  const Scene& stepped() const { return entry_.response == SceneResponse::bounce ? scene_ : passing_; }

  ContactCounts counted(ContactCounts counts) const {
    std::erase_if(counts, [&](const auto& entry) { return std::get<1>(entry.first) < entry_.first_counted; });
    return counts;
  }

  double body_time_of_all() const { return duration() * static_cast<double>(scene_.bodies.size()); }
  double duration() const { return scene_.end_time - scene_.world.start_time; }

  Contestant default_engine(const NamedDetector& detector) const {
    const auto transcript = std::make_shared<Transcript>(write_down(scene_, detector.make));
    const double body_time = transcript->body_time();
    SpeedRow row{.detector = detector.name,
                 .moves = static_cast<double>(transcript->probes) / body_time,
                 .contacts = static_cast<double>(transcript->contacts()) / body_time,
                 .missed = 0.0,
                 .hash = transcript->result.contact_hash};
    if (transcript->result.memory)
      row.bytes =
          static_cast<double>(transcript->result.memory->total()) / static_cast<double>(scene_.bodies.size());
    const auto play_again = [transcript, make = detector.make, body_time] {
      const Playing playing = play(*transcript, make);
      return Cost{playing.detecting / body_time, playing.building};
    };
    return {std::move(row), play_again};
  }

  /// Lets a group of rivals take turns, the default engine before them.
  void take_turns(std::vector<Contestant> contestants) {
    for (int turn = 0; turn < settings_.repetitions; ++turn) {
      if (turn > 0 && world_.is_slow && !contestants.empty()) break;
      const double world = take_turn(world_);
      world_.row.turns.push_back({world, world});
      for (Contestant& contestant : contestants) {
        if (turn > 0 && contestant.is_slow) continue;
        contestant.row.turns.push_back({take_turn(contestant), world});
      }
    }
    for (Contestant& contestant : contestants) {
      summarize(contestant);
      rows_.push_back(std::move(contestant.row));
    }
  }

  /// Runs a detector once, or repeatedly if it is too fast to be timed. Returns seconds for a body-second.
  double take_turn(Contestant& contestant) const {
    const double begin = cpu_seconds();
    double cost = 0.0;
    int runs = 0;
    double taken = 0.0;
    do {
      const Cost once = contestant.run();
      if (once.building) contestant.building.push_back(*once.building);
      cost += once.detection;
      ++runs;
      taken = cpu_seconds() - begin;
    } while (taken < settings_.least_turn);
    contestant.is_slow = taken > slow;
    return cost / runs;
  }

  void summarize(Contestant& contestant) const {
    std::vector<double> costs;
    for (const Turn& turn : contestant.row.turns) costs.push_back(turn.own);
    contestant.row.detection = median(std::move(costs));
    if (!contestant.building.empty()) contestant.row.building = median(contestant.building);
  }

  void run_steps(double rate, SphereTest test) {
    const double most =
        static_cast<double>(settings_.most_recorded) / static_cast<double>(scene_.bodies.size());
    const auto steps =
        static_cast<std::size_t>(std::max(1.0, std::min(std::round(rate * duration()), std::floor(most))));
    const StepRecording recording = record_steps(stepped(), 1.0 / rate, steps, test);
    const std::optional<ContactCounts> seen = seen_at_steps(rate, test);
    std::vector<Contestant> contestants;
    const auto enter = [&](const std::string& name, const KernelMaker& make) {
      if (make) contestants.push_back(fixed_steps(name, recording, make, seen));
    };
    enter(test == SphereTest::swept ? "swept" : "tuned", tuned_kernel(recording));
    if (entry_.trees && test == SphereTest::at_steps) {
      const auto& radii = recording.radii;
      if (make_bullet_kernel({})) enter("bullet", [&] { return make_bullet_kernel(radii); });
      enter("bullet-best", tuned_bullet_kernel(recording));
    }
    take_turns(std::move(contestants));
  }

  Contestant fixed_steps(const std::string& name, const StepRecording& recording, const KernelMaker& make,
                         const std::optional<ContactCounts>& seen) const {
    const auto kernel = make();
    const StepTiming timing = time_steps(recording, *kernel, recording.steps());
    SpeedRow row{.detector = name,
                 .settings = kernel->name(),
                 .rate = 1.0 / recording.step,
                 .moves = 1.0 / recording.step,
                 .bytes = static_cast<double>(timing.bytes) / static_cast<double>(recording.radii.size()),
                 .hash = timing.hash};
    if (entry_.response == SceneResponse::bounce)
      row.contacts = static_cast<double>(recording.contacts) / recording.body_time();
    else if (seen)
      row.contacts = static_cast<double>(total(*seen)) / body_time_of_all();
    if (seen) row.missed = missed_part(counted(*seen));
    const auto run = [&recording, make] {
      return Cost{time_steps(recording, *make(), recording.steps()).seconds / recording.body_time()};
    };
    return {std::move(row), run};
  }

  /// Returns the contacts that fixed steps see in the scene in which all bodies pass through; nothing if that
  /// would take too long.
  std::optional<ContactCounts> seen_at_steps(double rate, SphereTest test) const {
    const double steps = std::ceil(rate * duration());
    if (steps * static_cast<double>(scene_.bodies.size()) > static_cast<double>(settings_.most_looked))
      return std::nullopt;
    return contacts_at_steps(passing_, 1.0 / rate, static_cast<std::size_t>(steps), test);
  }

  std::optional<double> missed_part(const ContactCounts& seen) const {
    const std::uint64_t contacts = total(truth_);
    if (contacts == 0) return std::nullopt;
    return static_cast<double>(missed(truth_, seen)) / static_cast<double>(contacts);
  }

  const SpeedScene& entry_;
  const SpeedSettings& settings_;
  Scene scene_;
  Contestant world_;
  Scene passing_;        ///< the scene without bounces, with alarms, if there are any, as contacts
  ContactCounts truth_;  ///< contacts of passing_ that count
  std::vector<SpeedRow> rows_;
};

}  // namespace

double SpeedRow::to_world() const {
  std::vector<double> ratios;
  for (const Turn& turn : turns) ratios.push_back(turn.own / turn.world);
  return median(std::move(ratios));
}

std::vector<SpeedRow> compare_speed(const SpeedScene& scene, const SpeedSettings& settings) {
  return Contest(scene, settings).run();
}

}  // namespace kinesphere::program
