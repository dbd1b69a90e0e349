#include "distributed/distribution.hpp"

#include <algorithm>
#include <cmath>

#include "archive/archive.hpp"
#include "distributed/guarded.hpp"
#include "distributed/send_buffers.hpp"
#include "number/infinity.hpp"

namespace kinesphere {
namespace {

/// Limit of the imbalance, greatest work of a rank over mean work, beyond which space is divided anew.
constexpr double most_imbalance = 1.2;
/// A rank tells others of so many ways of its bodies one by one, each of which they look at for each of their
/// bodies. Where there are more, all know more of the space around its region.
constexpr std::ptrdiff_t most_ways_elsewhere = 32;

Box grown(Box box, double by) {
  const Vec3 margin{by, by, by};
  return {box.lower - margin, box.upper + margin};
}

bool comes_before(const BodyRecord& a, const BodyRecord& b) { return a.name < b.name; }

}  // namespace

/// Returns where a body is, in the primary box of periodic space.
Vec3 Distribution::place_of(const BodyRecord& body, double time) const {
  return space_.wrapped(body.body.bound.centre_at(time), time).position;
}

void Distribution::divide(std::span<BodyRecord> own, double time) {
  double work = 0.0;
  for (const BodyRecord& body : own) work += body.cost;
  const double most = -communicator_.least(-work);
  communicator_.sum(std::span(&work, 1));
  if (divisions_ > 0 && most * communicator_.ranks() <= most_imbalance * work) return;
  std::vector<Vec3> places;
  std::vector<double> costs;
  for (BodyRecord& body : own) {
    places.push_back(place_of(body, time));
    costs.push_back(1.0 + std::exchange(body.cost, 0.0));
  }
  partition_ = Partition::choose(communicator_, places, costs);
  ++divisions_;
}

Result<void> Distribution::assign(std::vector<BodyRecord>& own, double time) {
  if (communicator_.ranks() > 1) divide(own, time);
  SendBuffers buffers(communicator_.ranks());
  consensus_.note(guarded([&] {
    std::erase_if(own, [&](BodyRecord& body) {
      const bool is_of_checkpoint = !body.motion.empty();
      body.owner = partition_.owner_of(place_of(body, time));
      if (body.owner == communicator_.rank() && !is_of_checkpoint) return false;
      if (!is_of_checkpoint) {
        motion_.write_body(body.in_motion, body.motion).value();
        motion_.remove(body.in_motion).value();
      }
      buffers.add(body.owner, body);
      return true;
    });
  }));
  auto arrived = receive(buffers.exchange(communicator_));
  if (!arrived) return arrived.error();
  std::sort(arrived->begin(), arrived->end(), comes_before);
  const auto stayed = static_cast<std::ptrdiff_t>(own.size());
  std::move(arrived->begin(), arrived->end(), std::back_inserter(own));
  std::inplace_merge(own.begin(), own.begin() + stayed, own.end(), comes_before);
  return {};
}

/// Reads records, and adds their bodies to the motion.
Result<std::vector<BodyRecord>> Distribution::receive(std::vector<Communicator::Bytes> incoming) {
  std::vector<BodyRecord> records;
  for (Communicator::Bytes& bytes : incoming) {
    ByteReader reader(bytes);
    while (reader.remaining() > 0 && !reader.failed()) reader(records.emplace_back());
    bytes = {};
  }
  consensus_.note(guarded([&]() -> Result<void> {
    for (BodyRecord& record : records) {
      std::span<const std::byte> motion(record.motion);
      const auto number = motion_.read_body(motion);
      if (!number) return number.error();
      record.in_motion = *number;
      record.motion = {};
    }
    return {};
  }));
  if (auto agreed = consensus_.agree_on_noted(); !agreed) return agreed.error();
  return records;
}

/// Returns a box in which the safe region of a body is until the end of a slab, as far as it goes straight
/// on.
Box Distribution::way_of(const BodyRecord& body, const Slab& slab) const {
  const Bound& bound = body.body.bound;
  Vec3 now = place_of(body, slab.begin);
  double reach = body.region_reach;
  Vec3 centre = body.region_centre;
  if (body.is_arriving) {
    centre = now;
    reach = 4.0 * (bound.radius + body.first_radius);
  }
  // The two may be on both sides of a face of the primary box.
  if (space_.repeats()) now += space_.shift_to_nearest(now, centre, slab.begin);
  const Vec3 extent{reach, reach, reach};
  Box way{centre - extent, centre + extent};
  const double duration = std::min(slab.stop - slab.begin, 1e100);
  const Vec3 velocity = bound.velocity + bound.planned_acceleration * (slab.begin - bound.time);
  const Vec3 later = now + velocity * duration;
  for (int axis = 0; axis < 3; ++axis) {
    if (later[axis] + reach > way.upper[axis]) way.upper[axis] = later[axis] + reach;
    if (later[axis] - reach < way.lower[axis]) way.lower[axis] = later[axis] - reach;
  }
  return space_.within(way);
}

/// Returns the region of this rank and what is so far around it.
Box Distribution::region_around(double distance) const {
  Box region = partition_.region_of(communicator_.rank());
  for (int axis = 0; axis < 3; ++axis) {
    if (!space_.repeats(axis) || region.upper[axis] < region.lower[axis]) continue;
    region.lower[axis] = std::max(region.lower[axis], primary_.lower[axis]);
    region.upper[axis] = std::min(region.upper[axis], primary_.upper[axis]);
  }
  return grown(region, distance);
}

/// Makes known where the safe regions of each rank's bodies will be: so far around its region of space that
/// few ways of bodies lead elsewhere, and around these.
void Distribution::know(std::span<const Box> ways, double width) {
  HaloRegion& here = known_[communicator_.rank()];
  const auto leads_elsewhere = [&](const Box& way) { return !known_.covers(way); };
  double distance = width;
  for (;; distance *= 1.5) {
    const Box around = region_around(distance);
    here.assign(std::span(&around, 1));
    if (std::count_if(ways.begin(), ways.end(), leads_elsewhere) <= most_ways_elsewhere) break;
    // No distance around no space covers anything, and none grows from nothing.
    if (around.upper.x < around.lower.x || !(distance > 0.0 && distance < infinity)) break;
  }
  for (const Box& way : ways)
    if (leads_elsewhere(way)) here.add(grown(way, width));
  ByteWriter writer;
  writer(here.boxes());
  int rank = 0;
  for (const Communicator::Bytes& bytes : communicator_.gather(writer.bytes())) {
    std::vector<Box> boxes;
    ByteReader reader(bytes);
    reader(boxes);
    known_[rank++].assign(boxes);
  }
}

Result<std::vector<BodyRecord>> Distribution::send_ghosts(std::span<const BodyRecord> own, const Slab& slab,
                                                          const Halo& halo) {
  sent_.clear();
  if (communicator_.ranks() == 1) return std::vector<BodyRecord>();
  std::vector<Box> ways;
  ways.reserve(own.size());
  for (const BodyRecord& body : own) ways.push_back(way_of(body, slab));
  know(ways, halo.width);
  SendBuffers buffers(communicator_.ranks());
  ByteWriter writer;
  consensus_.note(guarded([&] {
    for (std::size_t k = 0; k < own.size(); ++k) {
      const std::vector<int> ranks = known_.ranks_that_meet(grown(ways[k], halo.margin));
      if (ranks.empty()) continue;
      BodyRecord ghost = own[k];
      motion_.write_body(ghost.in_motion, ghost.motion).value();
      writer.clear();
      writer(ghost);
      for (const int rank : ranks) {
        buffers.append(rank, writer.bytes());
        sent_.emplace_back(ghost.name, rank);
      }
    }
  }));
  return receive(buffers.exchange(communicator_));
}

void Distribution::drop(std::span<const BodyRecord> ghosts) {
  for (const BodyRecord& ghost : ghosts) (void)motion_.remove(ghost.in_motion);
}

Box Distribution::box_of(const core::Ghosts::Region& region) const {
  const Vec3 extent{region.reach, region.reach, region.reach};
  return space_.within({region.centre - extent, region.centre + extent});
}

/// Returns true if a body of this rank has come where another rank should have known it, or where this rank
/// may not have known others.
bool Distribution::lacks_ghosts(const Part& part) const {
  for (const core::Ghosts::Region& region : part.ghosts().regions()) {
    const Box box = box_of(region);
    if (!known_.covers(box)) return true;
    for (const int rank : known_.ranks_that_meet(box))
      if (!std::binary_search(sent_.begin(), sent_.end(), std::pair(part.name_of(region.ball), rank)))
        return true;
  }
  return false;
}

/// Returns true if a ghost whose course is wrong has been a neighbour of an own body, or should have been:
/// its safe regions, as its owner knows them, are in this box.
bool Distribution::concerns_own(const Part& part, std::uint32_t ghost, const Box& box) const {
  if (part.ghosts().is_neighbour(ghost)) return true;
  if (!known_.here().meets(box, space_)) return false;
  const auto regions = part.ghosts().regions();
  return std::any_of(regions.begin(), regions.end(),
                     [&](const core::Ghosts::Region& region) { return meet(box_of(region), box, space_); });
}

/// Sends to other ranks what has become of the bodies of which they have ghosts: the course of each, and a
/// box around its safe regions.
std::vector<Communicator::Bytes> Distribution::tell_courses(const Part& part) {
  std::vector<Box> boxes(part.numbers());
  std::vector<bool> has_box(part.numbers());
  for (const core::Ghosts::Region& region : part.ghosts().regions()) {
    const Vec3 extent{region.reach, region.reach, region.reach};
    Box& box = boxes[region.ball];
    const Box more{region.centre - extent, region.centre + extent};
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = has_box[region.ball] ? std::min(box.lower[axis], more.lower[axis]) : more.lower[axis];
      box.upper[axis] = has_box[region.ball] ? std::max(box.upper[axis], more.upper[axis]) : more.upper[axis];
    }
    has_box[region.ball] = true;
  }
  SendBuffers buffers(communicator_.ranks());
  for (const auto& [name, rank] : sent_) {
    const std::uint32_t number = part.number_of(name);
    buffers.add(rank, name, part.ghosts().course_of(number), space_.within(boxes[number]));
  }
  return buffers.exchange(communicator_);
}

std::uint64_t Distribution::count_disagreeing(const Part& part) {
  if (communicator_.ranks() == 1) return 0;
  bool disagrees = lacks_ghosts(part);
  for (const Communicator::Bytes& bytes : tell_courses(part)) {
    ByteReader reader(bytes);
    while (!disagrees && reader.remaining() > 0 && !reader.failed()) {
      std::uint32_t name = 0;
      std::uint64_t course = 0;
      Box box;
      reader(name, course, box);
      const std::uint32_t ghost = part.number_of(name);
      disagrees = part.ghosts().course_of(ghost) != course && concerns_own(part, ghost, box);
    }
  }
  return communicator_.sum(disagrees ? 1 : 0);
}

}  // namespace kinesphere
