#include "bench/speed/verdicts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace kinesphere::program {
namespace {

/// The total at 10 us per move need not be quite the ratio of moves.
constexpr double nearly = 0.95;

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
    detection("1", "paper1-1000", "tuned", 240.0, 1.0);
    detection("1", "paper1-1000", "bullet-best", 60.0, 1.0 / 3.0);
    detection("1 stretch", "paper1-1000", "tuned", 60.0, 1.0);
    detection("1", "paper1-3500", "tuned", 1000.0, 2.0);
    total("2", "paper1-1000", 60.0, 3.0);
    total("2", "paper1-1000", 240.0, 10.0);
    for (const double rate : {60.0, 240.0}) total_to_moves("2", "paper1-1000", rate);
    for (const char* const rival : {"tuned", "swept"}) safe("3", "drones", rival, 10.0);
    for (const char* const rival : {"tuned", "swept"}) safe("3", "bullets", rival, 100.0);
    collisions("4", "gas25-4000", 1.0e6);
    collisions("4", "gas49-4000", 1.5e6);
    growth();
    for (const char* const scene : {"paper1-500", "paper1-1000", "paper1-2000", "paper1-3500", "drones"})
      probes_to_floor("6", scene);
    for (const char* const scene : {"paper1-1000", "paper1-3500"}) paper("7", scene);
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

  void at_most(const char* goal, std::string figure, std::string scene, std::string against, double limit,
               double measured) {
    verdicts_.push_back(
        {goal, std::move(figure), std::move(scene), std::move(against), true, limit, measured});
  }
  void at_least(const char* goal, std::string figure, std::string scene, std::string against, double limit,
                double measured) {
    verdicts_.push_back(
        {goal, std::move(figure), std::move(scene), std::move(against), false, limit, measured});
  }

  void detection(const char* goal, const char* scene, const char* rival, double rate, double limit) {
    const SpeedRow* const against = row(scene, rival, rate);
    if (against == nullptr) return;
    at_most(goal, "detection to the rival's", scene, text_of(*against), limit,
            1.0 / against->to_world(*world(scene)));
  }

  void total(const char* goal, const char* scene, double rate, double limit) {
    const SpeedRow* const against = row(scene, "tuned", rate);
    if (against == nullptr) return;
    at_least(goal, "times cheaper in total at 1 us", scene, text_of(*against), limit,
             against->to_world(*world(scene), 1e-6));
  }

  void total_to_moves(const char* goal, const char* scene, double rate) {
    const SpeedRow* const against = row(scene, "tuned", rate);
    if (against == nullptr) return;
    const double moves = against->moves / world(scene)->moves;
    at_least(goal, fmt::format("times cheaper in total at 10 us to {:.3g} steps per probe", moves), scene,
             text_of(*against), nearly, against->to_world(*world(scene), 10e-6) / moves);
  }

  /// Where all steps that were tried miss something, those that miss least are cheaper than what is asked.
  void safe(const char* goal, const char* scene, const char* rival, double limit) {
    const auto* const all = rows(scene);
    if (all == nullptr) return;
    const SpeedRow* against = find_slowest_safe(*all, rival);
    if (against == nullptr) {
      for (const SpeedRow& one : *all)
        if (one.detector == rival && (against == nullptr || one.rate > against->rate)) against = &one;
    }
    if (against == nullptr) return;
    at_least(goal, "times cheaper in total at 100 ns", scene, text_of(*against), limit,
             against->to_world(*world(scene), 100e-9));
  }

  void collisions(const char* goal, const char* scene, double limit) {
    const SpeedRow* const own = world(scene);
    if (own == nullptr || !own->contacts) return;
    at_least(goal, "collisions per CPU second", scene, "", limit, *own->contacts / own->detection);
  }

  void growth() {
    const SpeedRow* const few = world("dense-1000");
    const SpeedRow* const many = world("dense-1000000");
    if (many == nullptr) return;
    if (few != nullptr)
      at_most("5", "detection to that of n = 1000", "dense-1000000", "", 3.0,
              many->detection / few->detection);
    if (many->bytes) at_most("5", "bytes per body", "dense-1000000", "", 512.0, *many->bytes);
    if (many->building) at_most("5", "seconds to build", "dense-1000000", "", 2.0, *many->building);
  }

  void probes_to_floor(const char* goal, const char* scene) {
    const SpeedRow* const own = world(scene);
    if (own == nullptr || !own->to_floor) return;
    at_most(goal, "probes to the floor", scene, "", 2.0, *own->to_floor);
  }

  void paper(const char* goal, const char* scene) {
    const SpeedRow* const against = row(scene, "paper");
    if (against == nullptr) return;
    at_least(goal, "times faster", scene, text_of(*against), 10.0, against->to_world(*world(scene)));
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

void save_verdicts(const Report& report, const std::vector<SpeedScene>& scenes, const SpeedResults& results) {
  save_safe_steps(report, scenes, results);
  ResultTable table({"goal", "figure", "scene", "against", "demanded", "limit", "measured", "met"});
  for (const Verdict& verdict : verdicts(results)) {
    table.row({verdict.goal, verdict.figure, verdict.scene, verdict.against,
               std::string(verdict.at_most ? "at most" : "at least"), verdict.limit, verdict.measured,
               std::string(verdict.met() ? "yes" : "no")});
  }
  report.note("What the default engine is to reach, as far as the scenes were run (docs/performance.md).");
  report.table("verdicts", table);
}

}  // namespace kinesphere::program
