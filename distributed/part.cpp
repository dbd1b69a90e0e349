#include "distributed/part.hpp"

#include <algorithm>
#include <utility>

#include "number/infinity.hpp"

namespace kinesphere {

Part::Part(const WorldDefinition& definition, const SensorTable& sensors, const WorldFacts& facts,
           double time, int rank, std::span<const BodyRecord* const> records, Motion& motion)
    : rank_(rank),
      motion_(motion),
      state_(definition),
      ghosts_(static_cast<std::uint32_t>(records.size())),
      main_(state_, time),
      numbers_(records.size()),
      source_(motion, in_motion_),
      probe_([this](std::span<const BodyId> ids, double now, std::span<State> states) {
        source_.states(ids, now, states);
      }),
      is_turned_(records.size()) {
  main_.reports().ask(probe_, "run");
  state_.contacts.find_numbers_in_tags();
  state_.bodies.sensors = sensors;
  state_.bodies.common_reach = facts.common_reach;
  state_.spot_checks = facts.spot_checks;
  if (facts.has_shapes) state_.bodies.rigid.note_elsewhere();
  main_.advance_clock(time);
  in_motion_.reserve(records.size());
  owners_.reserve(records.size());
  for (const BodyRecord* const record : records) install(*record);
  for (std::uint32_t number = 0; number < numbers(); ++number) link(number, *records[number]);
  state_.core.be_part(ghosts_, facts.first_radius, facts.grows, facts.drifts);
}

void Part::install(const BodyRecord& record) {
  Bodies& bodies = state_.bodies;
  const std::uint32_t number = kinesphere::install(record, bodies, state_.contacts, time());
  numbers_.add(record.name, number);
  in_motion_.push_back(record.in_motion);
  owners_.push_back(record.owner);
  if (record.owner != rank_) ghosts_.set_ghost(number);
  ghosts_.set_first_radius(number, record.first_radius);
  if (!bodies[number].dirty) return;
  bodies[number].dirty = false;
  main_.dirty().add(bodies, number, bodies[number].turned);
}

/// Links a body with others, as far as these are in this part.
void Part::link(std::uint32_t number, const BodyRecord& record) {
  std::vector<ContactRecord> partners;
  std::vector<OverlapRecord> overlaps;
  for (const auto& [name, state] : record.contacts.partners.all())
    if (const auto partner = numbers_.find(name)) partners.push_back({*partner, state});
  for (const OverlapRecord& overlap : record.contacts.overlaps)
    if (const auto partner = numbers_.find(overlap.partner))
      overlaps.push_back({*partner, overlap.distance, overlap.senses});
  state_.contacts.set_links(number, partners, std::move(overlaps));
  std::vector<PairNote> notes;
  for (const PairNote& note : record.notes)
    if (const auto partner = numbers_.find(note.partner))
      notes.push_back({*partner, note.state, note.turned_at});
  state_.contacts.pairs().set_of(number, std::move(notes));
  for (const auto& [name, until] : record.times)
    if (const auto other = numbers_.find(name))
      main_.pair_times().keep(state_.bodies, number, *other, until, time());
  if (!record.is_arriving) state_.core.adopt(number, numbered(number, record));
}

/// Returns what the core knows of a body, with numbers in place of names. A body that is due about one that
/// is not here finds out about others then.
core::Core::Record Part::numbered(std::uint32_t number, const BodyRecord& record) const {
  core::Core::Record core = record.core;
  std::size_t count = 0;
  for (const std::uint32_t name : core.neighbours)
    if (const auto neighbour = numbers_.find(name)) core.neighbours[count++] = *neighbour;
  core.neighbours.resize(count);
  if (core.ball.about != core::none) core.ball.about = numbers_.find(core.ball.about).value_or(number);
  return core;
}

BodyRecord Part::record_of(std::uint32_t number) const {
  BodyRecord record = kinesphere::record_of(state_.bodies, state_.contacts, number);
  record.owner = owners_[number];
  record.in_motion = in_motion_[number];
  record.core = state_.core.record_of(number);
  for (std::uint32_t& neighbour : record.core.neighbours) neighbour = name_of(neighbour);
  if (record.core.ball.about != core::none) record.core.ball.about = name_of(record.core.ball.about);
  record.region_centre = state_.core.region_centre(number);
  record.region_reach = state_.core.region_reach(number);
  return record;
}

/// Gives a record the notes back of those who are not in this part, with whom nothing has happened.
void Part::keep_notes(const BodyRecord& before, BodyRecord& now) const {
  for (const PairNote& note : before.notes)
    if (!numbers_.find(note.partner)) now.notes.push_back(note);
  std::sort(now.notes.begin(), now.notes.end(),
            [](const PairNote& a, const PairNote& b) { return a.partner < b.partner; });
}

std::uint64_t Part::update(std::vector<BodyRecord>& records) const {
  std::vector<std::uint32_t> places(numbers(), core::none);
  std::uint64_t notes = 0;
  for (std::uint32_t place = 0; place < records.size(); ++place) {
    const std::uint32_t number = number_of(records[place].name);
    notes += ghosts_.notes_of(number);
    const BodyRecord before = std::exchange(records[place], record_of(number));
    records[place].cost = before.cost + ghosts_.notes_of(number);
    keep_notes(before, records[place]);
    places[number] = place;
  }
  main_.pair_times().for_each(state_.bodies, [&](std::uint32_t a, std::uint32_t b, double until) {
    if (!(until > time())) return;
    if (places[a] != core::none) records[places[a]].times.push_back({name_of(b), until});
    if (a != b && places[b] != core::none) records[places[b]].times.push_back({name_of(a), until});
  });
  return notes;
}

Result<void> Part::begin() { return main_.recertify(); }

Result<void> Part::run(double stop, double until, std::size_t most, const ResponseFn* respond,
                       std::vector<OrderedEvent>& events) {
  main_.begin_call(until);
  std::optional<RankResponder> responder;
  if (respond != nullptr) responder.emplace(*respond, source_, state_.bodies);
  for (std::uint32_t round = 0;;) {
    if (main_.is_gathering())
      if (auto gathered = main_.gather(time()); !gathered) return gathered;
    while (const std::optional<Event> event = main_.pop())
      if (auto done = deliver(*event, round, responder ? &*responder : nullptr, events); !done) return done;
    if (auto recertified = main_.recertify(); !recertified) return recertified;
    ++round;
    if (!main_.events().pending().empty()) continue;
    const double next = main_.next_time();
    if (!(next < stop && next <= until)) break;
    if (next > time()) {
      if (events.size() >= most) return {};
      round = 0;
    }
    main_.begin_instant(next);
    if (auto noted = main_.note_instant(); !noted) return noted;
  }
  main_.advance_clock(std::min(stop, until));
  return {};
}

Result<void> Part::deliver(const Event& event, std::uint32_t round, RankResponder* responder,
                           std::vector<OrderedEvent>& events) {
  const BodyTable& table = state_.bodies.table();
  if (!ghosts_.is_ghost(table.number_of(event.first))) {
    OrderedEvent& own = events.emplace_back(OrderedEvent{event, round});
    own.event.first.world = own.event.second.world = 0;
  }
  if (responder == nullptr) return {};
  const auto answer = responder->respond(event);
  if (!answer) return answer.error();
  const auto parts = parts_of(event, *answer);
  for (const BodyResponse& part : parts) {
    if (!part.velocity) continue;
    const std::uint32_t number = table.number_of(part.body);
    if (is_turned_[number]) continue;
    before_.emplace_back(in_motion_[number], motion_.origin(in_motion_[number]));
    is_turned_[number] = true;
  }
  if (auto applied = responder->apply(event, *answer); !applied) return applied;
  for (const BodyResponse& part : parts)
    if (part.velocity) main_.set_velocity(part.body, *part.velocity);
  for (const BodyResponse& part : parts)
    if (part.angular_velocity) main_.set_angular_velocity(table.number_of(part.body), *part.angular_velocity);
  if (answer->pair_state)
    state_.contacts.pairs().set_state(table.number_of(event.first), table.number_of(event.second),
                                      *answer->pair_state);
  if (answer->turned_back) main_.turn_back(event);
  return {};
}

void Part::undo() {
  for (const auto& [in_motion, origin] : before_) motion_.set_origin(in_motion, origin).value();
  before_.clear();
}

}  // namespace kinesphere
