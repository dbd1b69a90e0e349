#include "research/bench/speed/verdicts.hpp"

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace kinesphere::program {
namespace {

/// Cost of a move, that is a probe or a step (seconds), in goals where few moves count more than little other
/// work.
constexpr double dear_move = 1e-6;

std::string text_of(const SpeedRow& row) {
  std::string text = row.detector;
  if (row.rate) text += fmt::format(" at {} Hz", *row.rate);
  if (row.missed && *row.missed > 0.0) text += fmt::format(" missing {:.2g} %", 100.0 * *row.missed);
  return text;
}

class Judge {
 public:
  explicit Judge(const SpeedResults& results) : results_(results) {}

  std::vector<Verdict> judge() {
    for (const char* const scene : {"paper1-500", "paper1-1000"}) detection(scene, "tuned", 60.0, 1.0);
    detection("paper1-3500", "tuned", 1000.0, 1.5);
    for (const char* const scene : {"paper1-500", "paper1-1000", "paper1-3500"})
      detection(scene, "bullet-best", 60.0, 1.0 / 3.0);
    for (const auto& [scene, rows] : results_) slowest_safe_steps(scene, rows);
    total("drones", "swept", 15.0, 10.0);
    total("bullets", "tuned", 1000.0, 100.0);
    growth();
    collisions("gas25-4000", 0.6e6);
    collisions("gas49-4000", 1.1e6);
    for (const char* const scene : {"paper1-500", "paper1-1000", "paper1-2000", "paper1-3500"})
      probes_to_floor(scene, 1.4);
    for (const char* const scene : {"drones", "crowd", "sizes"}) probes_to_floor(scene, 1.8);
    return std::move(verdicts_);
  }

 private:
  const std::vector<SpeedRow>* rows(const std::string& scene) const {
    const auto found = results_.find(scene);
    return found == results_.end() ? nullptr : &found->second;
  }
  const SpeedRow* row(const std::string& scene, const std::string& detector,
                      std::optional<double> rate = std::nullopt) const {
    const auto* const all = rows(scene);
    return all == nullptr ? nullptr : find_row(*all, detector, rate);
  }
  const SpeedRow* world(const std::string& scene) const { return row(scene, "world"); }

  void add(const char* goal, const char* figure, const std::string& scene, const std::string& against,
           bool at_most, double limit, double measured) {
    verdicts_.push_back({goal, figure, scene, against, at_most, limit, measured});
  }

  void detection(const char* scene, const char* rival, double rate, double limit) {
    const SpeedRow* const against = row(scene, rival, rate);
    if (against == nullptr) return;
    add("1", "detection to the rival's", scene, text_of(*against), true, limit,
        1.0 / against->to_world(*world(scene)));
  }

  void slowest_safe_steps(const std::string& scene, const std::vector<SpeedRow>& rows) {
    const SpeedRow* const against = find_slowest_safe(rows, "swept");
    if (against == nullptr) return;
    add("2", "detection to that of the slowest safe steps", scene, text_of(*against), true, 2.0,
        1.0 / against->to_world(*world(scene)));
    total(scene, *against, 1.0);
  }

  void total(const std::string& scene, const char* rival, double rate, double limit) {
    const SpeedRow* const against = row(scene, rival, rate);
    if (against != nullptr) total(scene, *against, limit);
  }
  void total(const std::string& scene, const SpeedRow& against, double limit) {
    add("2", "times cheaper in total at 1 us", scene, text_of(against), false, limit,
        against.to_world(*world(scene), dear_move));
  }

  void growth() {
    const SpeedRow* const few = world("dense-1000");
    const SpeedRow* const many = world("dense-1000000");
    if (many == nullptr) return;
    if (few != nullptr)
      add("3", "detection to that of n = 1000", "dense-1000000", "", true, 2.0,
          many->detection / few->detection);
    if (many->bytes) add("3", "bytes per body", "dense-1000000", "", true, 300.0, *many->bytes);
    if (many->building) add("3", "seconds to build", "dense-1000000", "", true, 1.2, *many->building);
  }

  void collisions(const char* scene, double limit) {
    const SpeedRow* const own = world(scene);
    if (own == nullptr || !own->contacts) return;
    add("4", "collisions per CPU second", scene, "", false, limit, *own->contacts / own->detection);
  }

  void probes_to_floor(const char* scene, double limit) {
    const SpeedRow* const own = world(scene);
    if (own == nullptr || !own->to_floor) return;
    add("5", "probes to the floor", scene, "", true, limit, *own->to_floor);
  }

  const SpeedResults& results_;
  std::vector<Verdict> verdicts_;
};

void save_safe_steps(const Report& report, const std::vector<SpeedScene>& scenes,
                     const SpeedResults& results) {
  ResultTable table({"scene", "n", "safe_detector", "safe_rate", "safe_us", "world_us", "ratio",
                     "ratio_100ns", "ratio_1us", "ratio_10us"});
  for (const SpeedScene& scene : scenes) {
    const auto rows = results.find(scene.name);
    if (rows == results.end()) continue;
    const SpeedRow& world = *find_row(rows->second, "world");
    for (const char* const name : {"tuned", "swept"}) {
      const SpeedRow* const safe = find_slowest_safe(rows->second, name);
      if (safe == nullptr) continue;
      std::vector<Cell> row{scene.name,  std::uint64_t{scene.bodies}, std::string(name),
                            *safe->rate, 1e6 * safe->detection,       1e6 * world.detection};
      for (const double price : move_prices) row.emplace_back(safe->to_world(world, price));
      table.row(std::move(row));
    }
  }
  report.note(
      "The slowest steps of those tried that miss no contact where all pass through, and how many times as "
      "much they take as the default engine, when a step or probe costs nothing, 100 ns, 1 us and 10 us.");
  report.table("safe_steps", table);
}

}  // namespace

std::vector<Verdict> verdicts(const SpeedResults& results) { return Judge(results).judge(); }

ResultTable table_of(const std::vector<Verdict>& verdicts) {
  ResultTable table({"goal", "figure", "scene", "against", "demanded", "limit", "measured", "met"});
  for (const Verdict& verdict : verdicts) {
    table.row({verdict.goal, verdict.figure, verdict.scene, verdict.against,
               std::string(verdict.at_most ? "at most" : "at least"), verdict.limit, verdict.measured,
               std::string(verdict.met() ? "yes" : "no")});
  }
  return table;
}

void save_verdicts(const Report& report, const std::vector<SpeedScene>& scenes, const SpeedResults& results) {
  save_safe_steps(report, scenes, results);
  report.note("What the default engine is to reach, as far as the scenes were run (research/decisions.md).");
  report.table("verdicts", table_of(verdicts(results)));
}

}  // namespace kinesphere::program
