// Runs a scene in a distributed world, with events in files and with checkpoints.
#include "distributed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <numeric>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "base/program_error.hpp"
#include "simulation/run/scene_answer.hpp"

namespace kinesphere::program {
namespace {

/// Events of a rank for which the length of a time slice is chosen; a slice is at most twice as long as the
/// one before. It limits the memory of events to a few times this number.
constexpr std::uint64_t events_of_a_slice = 1 << 16;
constexpr double slices_at_first = 1000.0;
/// Real time between two looks at the clock: a batch system lets a run live on for seconds after SIGTERM.
constexpr double seconds_of_a_slice = 0.25;

/// Returns the first different lines of two scene texts.
std::pair<std::string, std::string> first_difference(const std::string& a, const std::string& b) {
  std::istringstream lines_of_a(a);
  std::istringstream lines_of_b(b);
  std::pair<std::string, std::string> lines;
  while (std::getline(lines_of_a, lines.first) && std::getline(lines_of_b, lines.second) &&
         lines.first == lines.second) {
  }
  return lines;
}

}  // namespace

DistributedScene::DistributedScene(const Ranks& ranks, const Scene& scene, DistributedSceneOptions options,
                                   JobClock& clock, Workers* workers)
    : ranks_(ranks),
      scene_(scene),
      options_(std::move(options)),
      clock_(clock),
      workers_(workers),
      slice_((scene.end_time - scene.world.start_time) / slices_at_first) {}

void DistributedScene::start() {
  processor_seconds_at_start_ = processor_seconds();
  std::optional<RunState> resumed;
  if (!options_.checkpoint_folder.empty()) {
    checkpoints_.emplace(ranks_, options_.checkpoint_folder);
    resumed = resume();
  }
  const ContactFiles::Lengths lengths = resumed ? resumed->contact_lengths : ContactFiles::Lengths();
  contacts_.emplace(ranks_, options_.contacts, checkpoints_.has_value(), lengths);
  if (!resumed) create();
}

/// Deals bodies in slabs across the axis of their largest extent, equally many for each rank, so that few of
/// them have to migrate.
std::vector<std::uint32_t> DistributedScene::bodies_of_others() const {
  const auto position = [this](std::uint32_t body) {
    return scene_.motion->state(body, scene_.world.start_time).position;
  };
  std::vector<std::uint32_t> bodies(scene_.bodies.size());
  std::iota(bodies.begin(), bodies.end(), 0u);
  const auto extent = [&](int axis) {
    const auto [least, most] = std::minmax_element(
        bodies.begin(), bodies.end(),
        [&](std::uint32_t a, std::uint32_t b) { return position(a)[axis] < position(b)[axis]; });
    return least == bodies.end() ? 0.0 : position(*most)[axis] - position(*least)[axis];
  };
  const std::array extents{extent(0), extent(1), extent(2)};
  const auto axis = static_cast<int>(std::max_element(extents.begin(), extents.end()) - extents.begin());
  std::vector<double> along(bodies.size());
  for (const std::uint32_t body : bodies) along[body] = position(body)[axis];
  std::sort(bodies.begin(), bodies.end(),
            [&](std::uint32_t a, std::uint32_t b) { return std::tie(along[a], a) < std::tie(along[b], b); });
  const auto first_of = [&](int rank) {
    return bodies.begin() + static_cast<std::ptrdiff_t>(bodies.size()) * rank / ranks_.count();
  };
  bodies.erase(first_of(ranks_.rank()), first_of(ranks_.rank() + 1));
  return bodies;
}

void DistributedScene::create() {
  ranks_.together(1, [this] {
    motion_ = scene_.motion->clone();
    for (const std::uint32_t body : bodies_of_others()) require(motion_->remove(body));
  });
  world_.emplace(require_shared(DistributedWorld::create(scene_.world, *motion_), 1));
  ranks_.together(1, [this] {
    for (std::uint32_t body = 0; body < scene_.bodies.size(); ++body) {
      if (!motion_->contains(body)) continue;
      BodyDefinition definition = motion_->definition(body, scene_.world.start_time);
      definition.radius = scene_.bodies[body].radius;
      require(world_->add(body, definition, body));
    }
  });
}

/// Returns nothing if there is no checkpoint.
std::optional<RunState> DistributedScene::resume() {
  const std::vector<std::uint64_t> numbers = checkpoints_->latest();
  if (!options_.resume && !numbers.empty())
    throw SharedError(fmt::format("--checkpoint: expected a folder without checkpoints, or --resume, but {} "
                                  "has some",
                                  options_.checkpoint_folder),
                      exit_wrong_input);
  if (numbers.empty()) {
    if (options_.resume)
      tell_first(
          fmt::format("{}: no checkpoint yet, so the run begins at the start", options_.checkpoint_folder));
    return std::nullopt;
  }
  std::vector<std::uint64_t> refused;
  for (const std::uint64_t number : numbers) {
    RunState state;
    if (!restore(number, state)) {
      refused.push_back(number);
      continue;
    }
    for (const std::uint64_t bad : refused) checkpoints_->set_aside(bad);
    resumed_at_ = saved_at_ = state.time;
    return state;
  }
  throw SharedError(fmt::format("{}: expected a checkpoint that a run can go on from, but none is",
                                options_.checkpoint_folder),
                    1);
}

/// Returns false for a checkpoint that cannot be restored.
bool DistributedScene::restore(std::uint64_t number, RunState& state) {
  const auto refuse = [&](const std::string& why) {
    tell_first(fmt::format("{} is refused: {}", checkpoints_->path(number), why));
    return false;
  };
  try {
    state = checkpoints_->read_state(number);
  } catch (const SharedError& error) {
    return refuse(error.what());
  }
  require_same_run(state);
  world_.reset();
  ranks_.together(1, [this] {
    motion_ = scene_.motion->clone();
    for (std::uint32_t body = 0; body < scene_.bodies.size(); ++body) require(motion_->remove(body));
  });
  auto world = DistributedWorld::restore(checkpoints_->read_parts(number, state), *motion_);
  if (!world) return refuse(message_of(world.error()));
  if (world->time() != state.time || world->hash().parts() != state.hash)
    return refuse("its run.json is that of another one");
  world_.emplace(std::move(*world));
  return true;
}

void DistributedScene::require_same_run(const RunState& state) const {
  const auto refuse = [](const std::string& why) { throw SharedError(why, exit_wrong_input); };
  if (state.scene != options_.scene_text) {
    const auto [saved, given] = first_difference(state.scene, options_.scene_text);
    refuse(fmt::format("--resume: expected the scene of the checkpoints, with {}, but got {}", saved, given));
  }
  if (state.contacts != options_.contacts.output)
    refuse("--resume: expected --contacts and --file-per-rank as in the run that wrote the checkpoints");
  if (state.time > scene_.end_time)
    refuse(fmt::format("--seconds: expected no less than the checkpoint's time {}, but the scene ends at {}",
                       state.time, scene_.end_time));
}

void DistributedScene::tell_first(const std::string& message) const {
  if (ranks_.is_first()) fmt::print(stderr, "kinesphere-mpi: {}\n", message);
}

bool DistributedScene::run() {
  started_ = std::chrono::steady_clock::now();
  const auto respond = [this](const Event& event) { return scene_answer(scene_, event); };
  const auto sink = [this](const OrderedEvent& event) { contacts_->note(event); };
  bool is_stopped = false;
  for (bool goes_on = true; goes_on && !is_stopped;) {
    const double checkpoint = next_checkpoint();
    const double now = world_->time();
    double stop = std::min(scene_.end_time, checkpoint);
    if (contacts_->waits() || clock_.is_watched())
      stop = std::min(stop, std::max(now + slice_, std::nextafter(now, scene_.end_time)));
    const double began = clock_.elapsed();
    require_shared(world_->run(stop, respond, sink, workers_), 1);
    if (contacts_->waits() || clock_.is_watched()) choose_slice(clock_.elapsed() - began);
    if (contacts_->waits()) contacts_->write_noted();
    goes_on = stop < scene_.end_time;
    const JobClock::Wishes wishes = clock_.look();
    is_stopped = wishes.stop && goes_on;
    if (checkpoints_ && stop > saved_at_ &&
        (stop == checkpoint || is_stopped || wishes.checkpoint || (!goes_on && stop > now)))
      save();
    if (wishes.progress) tell_progress();
  }
  real_time_ = std::chrono::steady_clock::now() - started_;
  if (is_stopped)
    tell_first(fmt::format("stopped at {} of {} s, with a checkpoint in {}; --resume goes on", world_->time(),
                           scene_.end_time, options_.checkpoint_folder));
  return !is_stopped;
}

/// The first rank says how far the run has come, and how evenly ranks work.
void DistributedScene::tell_progress() const {
  const RankUse own = use();
  double mean = 0.0, most = 0.0;
  for (const double work : ranks_.gather(own.processor_seconds - own.figures.seconds_in_mpi)) {
    mean += work / ranks_.count();
    most = std::max(most, work);
  }
  const double begin = resumed_at_.value_or(scene_.world.start_time);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - started_;
  const double rate = (world_->time() - begin) / passed.count();
  tell_first(fmt::format(
      "{:.6g} of {:.6g} s simulated, {:.3g} a second, the rest in about {:.0f} s; the busiest rank "
      "works {:.2f} times the mean",
      world_->time(), scene_.end_time, rate, (scene_.end_time - world_->time()) / rate,
      mean > 0.0 ? most / mean : 1.0));
}

/// Returns the next multiple of the interval, counted from the start.
double DistributedScene::next_checkpoint() const {
  if (!checkpoints_ || !options_.checkpoint_interval) return std::numeric_limits<double>::infinity();
  const double start = scene_.world.start_time;
  const double interval = *options_.checkpoint_interval;
  double count = std::floor((world_->time() - start) / interval);
  while (start + count * interval <= world_->time()) ++count;
  return start + count * interval;
}

/// Chooses the next slice from what the last one has taken (seconds) and told.
void DistributedScene::choose_slice(double seconds) {
  double longer = 2.0;
  if (contacts_->waits()) {
    const std::uint64_t most = std::max<std::uint64_t>(contacts_->most_waiting(), 1);
    longer = std::min(longer, static_cast<double>(events_of_a_slice) / static_cast<double>(most));
  }
  if (clock_.is_watched()) {
    const std::uint64_t slowest = ranks_.largest(static_cast<std::uint64_t>(1e6 * seconds) + 1);
    longer = std::min(longer, 1e6 * seconds_of_a_slice / static_cast<double>(slowest));
  }
  slice_ *= std::clamp(longer, 0.5, 2.0);
}

void DistributedScene::save() {
  const auto part = require_shared(world_->save(), 1);
  RunState state{.scene = options_.scene_text,
                 .time = world_->time(),
                 .parts = static_cast<std::uint64_t>(ranks_.count()),
                 .hash = world_->hash().parts(),
                 .contacts = options_.contacts.output};
  state.contact_lengths = contacts_->sync();
  checkpoints_->write(part, state);
  saved_at_ = state.time;
}

RankUse DistributedScene::use() const {
  return {.figures = world_->figures(),
          .processor_seconds = processor_seconds() - processor_seconds_at_start_,
          .largest_memory = largest_memory()};
}

RunTotals DistributedScene::totals() const {
  return {.counters = world_->counters(),
          .hash = world_->hash(),
          .resumed_at = resumed_at_,
          .simulated_seconds = scene_.end_time - resumed_at_.value_or(scene_.world.start_time),
          .real_seconds = real_time_.count()};
}

}  // namespace kinesphere::program
