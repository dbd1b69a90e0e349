#include "distributed/rank_engine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "bodies/validation.hpp"
#include "contact/contact_predictor.hpp"
#include "distributed/guarded.hpp"
#include "number/infinity.hpp"
#include "number/scope_guard.hpp"

namespace kinesphere {
namespace {

/// Ranks have ghosts so far around the safe regions of their own bodies at first, in widths of these. More of
/// them allow longer slabs.
constexpr double first_margin = 3.0, least_margin = 0.5;
/// In a slab so much is to happen to each body, which makes what a slab costs beside worth it.
constexpr double wanted_work = 12.0;
/// A slab that failed is tried again with this part of its duration, and with so many times the ghosts
/// around; one that did not lets the next one have less of them.
constexpr double shorter = 0.5, wider = 1.25, narrower = 0.97;
/// A single rank stops after about so many events, which have to be kept until then.
constexpr std::size_t most_events = 1 << 16;

}  // namespace

DistributedWorld::RankEngine::RankEngine(const WorldDefinition& definition, Motion& motion,
                                         std::optional<int> communicator)
    : definition_(definition),
      motion_(motion),
      communicator_(communicator),
      consensus_(communicator_),
      distribution_(communicator_, consensus_, definition_, motion),
      time_(definition.start_time),
      arriving_(std::make_unique<WorldState>(definition)),
      margin_(first_margin) {}

RankFigures DistributedWorld::RankEngine::figures() const {
  const Communicator::Traffic& traffic = communicator_.traffic();
  return {.bodies = own_bodies(),
          .ghosts = ghosts_,
          .bytes = traffic.bytes,
          .messages = traffic.messages,
          .collectives = traffic.collectives,
          .batches = slabs_,
          .rounds = tries_,
          .partitions = distribution_.divisions(),
          .seconds_in_mpi = traffic.seconds};
}

Result<void> DistributedWorld::RankEngine::check_run(double until, const PoolLease& lease) const {
  if (auto valid = consensus_.check("run"); !valid) return valid;
  if (auto time_is_valid = check_time(until, time(), definition()); !time_is_valid) {
    Error error = time_is_valid.error();
    if (error.message.rfind("advance:", 0) == 0) error.message.replace(0, 8, "run:");
    return error;
  }
  if (!lease)
    return Error{ErrorCode::workers_busy, "workers", no_body,
                 "run: workers must not be at work in another run, but are"};
  return {};
}

Result<void> DistributedWorld::RankEngine::run(double until, const ResponseFn* respond,
                                               const OrderedEventFn& sink, Workers* workers) {
  const PoolLease lease(workers);
  if (auto agreed = agree(check_run(until, lease)); !agreed) return agreed;
  return go(until, respond, sink);
}

Result<void> DistributedWorld::RankEngine::go(double until, const ResponseFn* respond,
                                              const OrderedEventFn& sink) {
  if (auto started = start_arrivals(); !started) return started;
  for (bool is_over = false; !is_over;) {
    const auto done = run_slab(until, respond);
    if (!done) return done.error();
    is_over = *done;
    deliver(sink);
  }
  return consensus_.agree_on_noted();
}

/// Returns when something happens to a body of any rank next, as far as its records tell.
double DistributedWorld::RankEngine::first_due() {
  double first = infinity;
  for (const BodyRecord& record : own_)
    first = std::min(first, record.body.dirty ? time_ : std::max(record.core.ball.due, time_));
  return communicator_.least(first);
}

/// Returns how far around their regions of space ranks know bodies, if nothing makes them know more.
Halo DistributedWorld::RankEngine::usual_halo() {
  std::array<double, 2> sums{0.0, static_cast<double>(own_.size())};
  for (const BodyRecord& record : own_)
    sums[0] += record.is_arriving ? record.body.bound.radius + facts_.first_radius : record.region_reach;
  communicator_.sum(sums);
  const double width = sums[1] > 0.0 ? 2.0 * sums[0] / sums[1] : 0.0;
  return {width, margin_ * width};
}

/// Returns a time in which bodies move about as far as they are apart; infinity if they all stand still.
double DistributedWorld::RankEngine::first_duration() {
  std::array<double, 2> sums{};
  for (const BodyRecord& record : own_) {
    const Bound& bound = record.body.bound;
    const double way = std::max(facts_.first_radius, bound.radius);
    const double time =
        std::min(way / (norm(bound.velocity) + bound.growth_speed),
                 std::sqrt(2.0 * way / (bound.acceleration_limit + norm(bound.planned_acceleration))));
    if (!(time < infinity)) continue;
    sums[0] += 1.0 / time;
    sums[1] += 1.0;
  }
  communicator_.sum(sums);
  return sums[0] > 0.0 ? 2.0 * sums[1] / sums[0] : infinity;
}

/// Advances by a slab. Returns true if this has reached `until`. Errors: those of all ranks, equal on all.
Result<bool> DistributedWorld::RankEngine::run_slab(double until, const ResponseFn* respond) {
  if (auto assigned = distribution_.assign(own_, time_); !assigned) return assigned.error();
  if (!(duration_ > 0.0)) duration_ = first_duration();
  if (communicator_.ranks() == 1) duration_ = infinity;
  const double first = first_due();
  double duration = duration_, latest = infinity;
  Halo halo = usual_halo();
  for (;;) {
    ++tries_;
    const double least = just_after(first);
    Slab slab{.begin = time_, .stop = std::clamp(first + duration, least, std::max(latest, least))};
    if (facts_.spot_checks.next() > time_) slab.stop = std::min(slab.stop, facts_.spot_checks.next());
    slab.is_least = !(slab.stop > least);
    const auto outcome = try_slab(slab, until, halo, respond);
    if (!outcome) return outcome.error();
    if (outcome->is_done) {
      ++slabs_;
      margin_ = std::max(margin_ * narrower, least_margin);
      const double wanted = (time_ - first) * wanted_work / std::max(outcome->work, 0.125 * wanted_work);
      duration_ = std::clamp(wanted, 0.5 * duration_, 2.0 * duration_);
      return !(time_ < until) && outcome->stop > until;
    }
    latest = std::min(latest, outcome->failed_at);
    duration *= shorter;
    margin_ *= wider;
    halo = {wider * halo.width, wider * halo.margin};
  }
}

/// Simulates a slab. If a rank fails, or some do not agree, all go back to the begin of the slab. Errors: of
/// a slab that cannot be shorter, and those of exchanges.
Result<DistributedWorld::RankEngine::Outcome> DistributedWorld::RankEngine::try_slab(
    const Slab& slab, double until, const Halo& halo, const ResponseFn* respond) {
  auto ghosts = distribution_.send_ghosts(own_, slab, halo);
  if (!ghosts) return ghosts.error();
  ghosts_ = ghosts->size();
  std::vector<const BodyRecord*> records;
  for (const auto* const some : {&std::as_const(own_), &std::as_const(*ghosts)})
    for (const BodyRecord& record : *some) records.push_back(&record);
  std::sort(records.begin(), records.end(),
            [](const BodyRecord* a, const BodyRecord* b) { return a->name < b->name; });
  Part part(definition_, sensors_, facts_, time_, communicator_.rank(), records, motion_);
  const ScopeGuard drop([&] { distribution_.drop(*ghosts); });
  ScopeGuard go_back([&] { part.undo(); });
  std::vector<OrderedEvent> events;
  auto done = guarded([&] { return part.begin(); });
  std::array<std::uint64_t, 1> failures{done ? 0u : 1u};
  communicator_.sum(failures);
  if (failures[0] == 0 && facts_.spot_checks.next() <= time_)
    if (auto checked = spot_check(part); !checked) return checked.error();
  const double stop = std::min(slab.stop, part.state().spot_checks.next());
  const std::size_t most = communicator_.ranks() == 1 ? most_events : std::numeric_limits<std::size_t>::max();
  if (failures[0] == 0) done = guarded([&] { return part.run(stop, until, most, respond, events); });
  const bool grows = part.state().core.balls().any_grows();
  std::array<std::uint64_t, 2> sums{done ? 0u : 1u, grows && !facts_.grows ? 1u : 0u};
  communicator_.sum(sums);
  if (sums[0] > 0) {
    if (slab.is_least) return agree(done).error();
    return Outcome{.failed_at = communicator_.least(done ? infinity : part.time())};
  }
  // Whether any bound grows decides how all are compared.
  if ((sums[1] > 0 && !slab.is_least) || distribution_.count_disagreeing(part) > 0) return Outcome{};
  go_back.dismiss();
  facts_.grows = facts_.grows || sums[1] > 0;
  const double work = commit(part, events);
  return Outcome{.is_done = true, .stop = stop, .work = work};
}

/// Checks exact bodies, as World::Engine::spot_check() does.
Result<void> DistributedWorld::RankEngine::spot_check(Part& part) {
  EventProcessor& main = part.main();
  const auto own_probes = [&] { return counters_.probes + main.counters().probes; };
  const std::uint64_t probes = communicator_.sum(own_probes());
  std::vector<std::uint32_t> all(part.numbers());
  std::iota(all.begin(), all.end(), 0u);
  const auto here = guarded([&] { return main.spot_check_due(all, probes); });
  if (auto agreed = agree(here ? Result<void>() : here.error()); !agreed) return agreed;
  std::array<std::uint64_t, 3> sums{here->any, here->moving, own_probes()};
  communicator_.sum(sums);
  core::StayCounts stays = part.state().core.count_stays();
  communicator_.sum(stays.counts());
  const SpotChecks::Census census{sums[0] > 0, sums[1], communicator_.least(here->least_time)};
  part.state().spot_checks.note_check(stays.median(), time_, census, sums[2]);
  return {};
}

/// Takes over what a part has become. Returns how much has happened to a body, on the mean of all ranks.
double DistributedWorld::RankEngine::commit(Part& part, std::vector<OrderedEvent>& events) {
  std::array<std::uint64_t, 2> sums{part.update(own_), own_.size()};
  communicator_.sum(sums);
  counters_ += part.main().counters();
  facts_.spot_checks = part.state().spot_checks;
  time_ = part.time();
  for (const OrderedEvent& event : events) {
    hash_.add(event.event);
    events_.push_back(event);
  }
  return static_cast<double>(sums[0]) / static_cast<double>(std::max<std::uint64_t>(sums[1], 1));
}

/// Passes pending events to the sink. An exception thrown by the sink ends the run on all ranks.
void DistributedWorld::RankEngine::deliver(const OrderedEventFn& sink) {
  try {
    while (!events_.empty() && !consensus_.has_noted()) {
      const OrderedEvent event = events_.front();
      events_.pop_front();
      sink(event);
    }
  } catch (const std::exception& thrown) {
    consensus_.note(
        Error{ErrorCode::callback_threw, "sink", no_body, std::string("run: sink: ") + thrown.what()});
  } catch (...) {
    consensus_.note(
        Error{ErrorCode::callback_threw, "sink", no_body, "run: sink threw what is no std::exception"});
  }
}

}  // namespace kinesphere
