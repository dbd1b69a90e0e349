// The idea of the library on one page, without the library: every contact of spheres whose paths nobody
// knows.
//
// Thirty spheres go round on circles, but only a probe knows that. Four steps follow: what a promise allows
// (1), until when two spheres certainly stay apart (2), one queue of such times (3), and a loop (4). At the
// end (5) the library does the same work, and must find the same contacts.
#include <kinesphere/world.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <queue>
#include <vector>

using namespace kinesphere;

namespace {

constexpr double tolerance = 1e-6;  // a contact begins while the gap is at most this
constexpr double apart = 4e-6;      // and ends when it is at least this

/// A path that neither the loop below nor the library knows, and a promise that it keeps: the length of its
/// acceleration is at most `limit`.
struct Path {
  Vec3 middle;
  double circle, rate, phase, radius;
  double limit() const { return 1.0001 * circle * rate * rate; }
  State at(double t) const {
    const double c = std::cos(rate * t + phase), s = std::sin(rate * t + phase);
    return {middle + Vec3{circle * c, circle * s, 0}, Vec3{-s, c, 0} * (circle * rate)};
  }
};

/// (1) The bound. After a report of place and velocity, a body is within error(t) of where it would be if it
/// flew straight on: a ball that moves and grows.
struct Bound {
  double time;
  State report;
  double limit;
  Vec3 centre(double t) const { return report.position + report.velocity * (t - time); }
  double error(double t) const { return 0.5 * limit * (t - time) * (t - time); }
  double error_of_velocity(double t) const { return limit * (t - time); }
};

/// Solves way = speed s + acceleration s^2 / 2 for the first s >= 0; infinite if that never comes.
double time_for(double way, double speed, double acceleration) {
  if (way <= 0.0) return 0.0;
  const double root = speed * speed + 2.0 * acceleration * way;
  if (root < 0.0 || speed + std::sqrt(root) <= 0.0) return HUGE_VAL;
  return 2.0 * way / (speed + std::sqrt(root));
}

/// (2) The certificate: a time before which the gap of two bodies is certainly above `least`. Seen along the
/// line between their centres, the gap shrinks at most with the speed at which the centres approach, with
/// what the velocities may be off, and with what both may accelerate. The true distance is never less than
/// that.
double apart_until(const Bound& a, const Bound& b, double radii, double t, double least) {
  const Vec3 line = b.centre(t) - a.centre(t);
  const double distance = norm(line);
  const double gap = distance - radii - a.error(t) - b.error(t);
  const double approach = dot(a.report.velocity - b.report.velocity, line) / distance;
  const double unknown = a.error_of_velocity(t) + b.error_of_velocity(t);
  return t + time_for(gap - least, approach + unknown, a.limit + b.limit);
}

/// The same for two bodies in touch: a time before which the gap is certainly below `most`.
double touching_until(const Bound& a, const Bound& b, double radii, double t, double most) {
  const double gap = norm(b.centre(t) - a.centre(t)) - radii + a.error(t) + b.error(t);
  const double speed = norm(a.report.velocity - b.report.velocity);
  const double unknown = a.error_of_velocity(t) + b.error_of_velocity(t);
  return t + time_for(most - gap, speed + unknown, a.limit + b.limit);
}

struct Contact {
  double time;
  std::size_t a, b;
  bool begins;
};

/// (3) A pair in the queue, with the time at which its certificate ends.
struct Pair {
  double due;
  std::size_t a, b;
  bool touching;
  bool operator<(const Pair& other) const { return due > other.due; }
};

/// (4) The loop. Every pair is in the queue, so until the first of them is due nothing can happen: time goes
/// there at once. Nothing is missed, since a certificate is never late; nothing is invented, since a contact
/// is told only after both bodies have been asked.
std::vector<Contact> find(const std::vector<Path>& paths, double until, int& probes) {
  std::vector<Bound> bounds;
  for (const Path& path : paths) bounds.push_back({0.0, path.at(0.0), path.limit()});
  const auto radii = [&](const Pair& pair) { return paths[pair.a].radius + paths[pair.b].radius; };
  const auto certify = [&](Pair& pair, double t) {
    pair.due = pair.touching
                   ? touching_until(bounds[pair.a], bounds[pair.b], radii(pair), t, apart + tolerance)
                   : apart_until(bounds[pair.a], bounds[pair.b], radii(pair), t, 0.0);
  };
  std::priority_queue<Pair> queue;
  for (std::size_t a = 0; a < paths.size(); ++a)
    for (std::size_t b = a + 1; b < paths.size(); ++b) {
      Pair pair{0.0, a, b, false};
      certify(pair, 0.0);
      queue.push(pair);
    }
  std::vector<Contact> found;
  while (queue.top().due <= until) {
    Pair pair = queue.top();
    queue.pop();
    const double t = pair.due;
    certify(pair, t);  // one of the two may have been asked since, for another pair
    // A better bound: the one with the older report is asked, then the other.
    for (int k = 0; k < 2 && pair.due <= t; ++k) {
      const std::size_t asked = bounds[pair.a].time <= bounds[pair.b].time ? pair.a : pair.b;
      if (bounds[asked].time == t) break;
      bounds[asked] = {t, paths[asked].at(t), paths[asked].limit()};
      ++probes;
      certify(pair, t);
    }
    // Both reports are of now: the gap is known.
    if (bounds[pair.a].time == t && bounds[pair.b].time == t) {
      const double gap = norm(bounds[pair.b].centre(t) - bounds[pair.a].centre(t)) - radii(pair);
      if (pair.touching ? gap >= apart : gap <= tolerance) {
        pair.touching = !pair.touching;
        found.push_back({t, pair.a, pair.b, pair.touching});
        certify(pair, t);
      }
    }
    queue.push(pair);
  }
  return found;
}

/// (5) The same by the library, which asks for far fewer pairs: it keeps bodies in cells of space, so that
/// most pairs never get a certificate.
std::vector<Contact> find_with_library(const std::vector<Path>& paths, double until, int& probes) {
  World world =
      World::create({.contact_tolerance = tolerance, .contacts = ContactEvents::begin_and_end}).value();
  for (const Path& path : paths)
    world
        .add({.radius = path.radius,
              .acceleration_limit = path.limit(),
              .position = path.at(0.0).position,
              .velocity = path.at(0.0).velocity})
        .value();
  const auto probe = [&](std::span<const BodyId> ids, double t, std::span<State> states) {
    for (std::size_t k = 0; k < ids.size(); ++k) states[k] = paths[ids[k].index].at(t);
  };
  std::vector<Contact> found;
  for (const Event& event : world.events(until, probe)) {
    const auto [a, b] = std::minmax(event.first.index, event.second.index);
    found.push_back({event.time, a, b, event.kind == EventKind::contact_begin});
  }
  probes = static_cast<int>(world.counters().probes);
  return found;
}

}  // namespace

int main() {
  std::vector<Path> paths;
  for (int k = 0; k < 30; ++k) {
    const double x = std::fmod(0.618 * k, 1.0), y = std::fmod(0.755 * k, 1.0);
    paths.push_back({{20 * x, 20 * y, 0}, 2 + 3 * y, 0.3 + 0.5 * x, 6.0 * x, 0.3 + 0.2 * y});
  }
  int asked = 0, asked_by_library = 0;
  const std::vector<Contact> found = find(paths, 60.0, asked);
  const std::vector<Contact> same = find_with_library(paths, 60.0, asked_by_library);

  // Per pair the same begins and ends, at the same times up to the tolerances.
  std::map<std::pair<std::size_t, std::size_t>, std::vector<Contact>> of_pair;
  for (const Contact& contact : same) of_pair[{contact.a, contact.b}].push_back(contact);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> seen;
  bool equal = found.size() == same.size();
  for (const Contact& contact : found) {
    const std::pair pair{contact.a, contact.b};
    const std::size_t k = seen[pair]++;
    equal = equal && k < of_pair[pair].size() && of_pair[pair][k].begins == contact.begins &&
            std::abs(of_pair[pair][k].time - contact.time) < 1e-3;
  }
  std::printf("%zu begins and ends in 60 s, %s those of the library\n", found.size(),
              equal ? "equal to" : "but not");
  std::printf("%.1f thousand probes here, %.1f by the library; a loop at 60 Hz takes %.1f\n", asked / 1e3,
              asked_by_library / 1e3, 30 * 60 * 60 / 1e3);
  return equal ? 0 : 1;
}
