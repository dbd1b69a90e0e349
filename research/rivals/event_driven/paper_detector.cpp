// The algorithm of the paper: time-varying bounds on hierarchical grids, and four kinds of events (sections
// 3.2, 3.3 and 4.1).
#include <array>

#include "input/input_check.hpp"
#include "research/rivals/event_driven/event_driven_detector.hpp"
#include "research/rivals/rivals.hpp"
#include "simulation/detector/checked_detector.hpp"

namespace kinesphere {
namespace {

/// Largest cell edge (length): planes are products of an edge and an index, and none may overflow.
constexpr double largest_edge = 1e200;

class PaperDetector final : public EventDrivenDetector {
 public:
  PaperDetector(const WorldDefinition& definition, const Motion& motion, const PaperOptions& options)
      : EventDrivenDetector(
            definition, motion,
            {.cell_edge = options.cell_edge, .trimming = options.trimming, .meeting_time = nullptr}) {}

  std::string_view name() const override { return "paper"; }

 private:
  void on_outgrown(std::uint32_t number) override {
    probe(number);
    reset(std::span(&number, 1));
  }

  /// Resets both bodies, in contact or not.
  void on_meeting(std::uint32_t a, std::uint32_t b) override {
    std::array<std::uint32_t, 2> stale{};
    std::size_t count = 0;
    if (!fresh(a)) stale[count++] = a;
    if (b != a && !fresh(b)) stale[count++] = b;
    // Both bodies were reset at this instant already.
    if (count == 0) return predict_pair(a, b);
    ++counters_.colliding;
    for (std::size_t k = 0; k < count; ++k) probe(stale[k]);
    reset(std::span(stale.data(), count));
  }
};

}  // namespace

Result<std::unique_ptr<Detector>> make_paper_detector(const WorldDefinition& definition, const Motion& motion,
                                                      const PaperOptions& options) {
  if (auto valid = check_world(definition); !valid) return valid.error();
  if (auto valid = InputCheck("make_paper_detector")
                       .from_zero_to({"options", no_body, "cell_edge"}, options.cell_edge, largest_edge)
                       .result();
      !valid)
    return valid.error();
  return make_checked<PaperDetector>(definition, motion, options);
}

}  // namespace kinesphere
