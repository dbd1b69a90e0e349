#include "kinesphere/expanding_box.hpp"

#include <cmath>

#include "input/input_check.hpp"
#include "number/exponential.hpp"
#include "number/infinity.hpp"

namespace kinesphere {

Result<ExpandingBox> ExpandingBox::create(const Definition& definition) {
  const auto check = InputCheck("ExpandingBox::create")
                         .finite({"rate"}, definition.rate)
                         .finite({"start_time"}, definition.start_time);
  if (check.error()) return *check.error();
  return ExpandingBox(definition);
}

double ExpandingBox::scale(double time) const {
  const double strain = of_.rate * (time - of_.start_time);
  return 1.0 + (of_.flow == Flow::free ? strain : exponential_less_one(strain));
}

double ExpandingBox::clock(double time) const {
  const double since = time - of_.start_time;
  if (of_.rate == 0.0) return since;
  if (of_.flow == Flow::carried) return -exponential_less_one(-of_.rate * since) / of_.rate;
  const double size = scale(time);
  return size > 0.0 ? since / size : std::copysign(infinity, since);
}

double ExpandingBox::time(double clock) const {
  const double left = 1.0 - of_.rate * clock;
  if (left <= 0.0) return std::copysign(infinity, clock);
  if (of_.rate == 0.0) return of_.start_time + clock;
  return of_.start_time +
         (of_.flow == Flow::free ? clock / left : -logarithm_of_one_and(-of_.rate * clock) / of_.rate);
}

State ExpandingBox::seen(const State& real, double time) const {
  const double size = scale(time);
  const bool is_free = of_.flow == Flow::free;
  return {real.position / size, is_free ? size * real.velocity - of_.rate * real.position : real.velocity};
}

State ExpandingBox::real(const State& seen, double clock) const {
  const double size = scale_at(clock);
  const bool is_free = of_.flow == Flow::free;
  return {size * seen.position, is_free ? seen.velocity / size + of_.rate * seen.position : seen.velocity};
}

Event ExpandingBox::real(Event event) const {
  const double clock = event.time, size = scale_at(clock);
  // A speed is seen so many times as high.
  const double faster = of_.flow == Flow::free ? size : 1.0;
  event.time = time(clock);
  if (event.first != no_body) event.first_state = real(event.first_state, clock);
  if (event.second != no_body) event.second_state = real(event.second_state, clock);
  event.point *= size;
  event.approach_speed = event.approach_speed / faster - of_.rate * event.gap * (size / faster);
  event.gap *= size;
  event.distance *= size;
  event.position_excess *= size;
  event.velocity_excess /= faster;
  return event;
}

}  // namespace kinesphere
