// The invariants of the core, checked by brute force.
#include <algorithm>
#include <cmath>

#include "contact/contact_predictor.hpp"
#include "core/core.hpp"
#include "number/infinity.hpp"

namespace kinesphere::core {

/// Returns the distance of the centres of two safe regions, in the nearest images; where these slide, the
/// least one of some times until `end`.
double Core::least_distance(const Ball& a, const Ball& b, double end) const {
  const Vec3 from = region_centre(a), to = region_centre(b);
  if (!space_.slides()) return norm(balls_.nearest(to - from));
  double least = infinity;
  const double last = std::min(end, balls_.time() + 1.0);
  for (const double time : {balls_.time(), 0.5 * (balls_.time() + last), last})
    least = std::min(least, norm(to + space_.shift_to_nearest(to, from, time) - from));
  return least;
}

const char* Core::audit(const std::function<Claim(std::uint32_t, std::uint32_t)>& claim_of) const {
  const auto present = [this](std::uint32_t number) {
    return balls_[number].is_present() && !balls_[number].is(Ball::arriving);
  };
  for (std::uint32_t a = 0; a < balls_.size(); ++a) {
    if (!present(a) || claim_of(a, a) == Claim::nothing) continue;
    const Ball& ball = balls_[a];
    const Bound own = balls_.bound(a);
    const double left = std::min(ball.own, balls_.time() + 1e6 * std::max(1.0, std::abs(balls_.time())));
    // A ball that may have left its safe region is due now, or at the next time that there is.
    if (claim_of(a, a) == Claim::meet_as_balls && ball.own > just_after(balls_.time())) {
      for (const double time : {balls_.time(), 0.5 * (balls_.time() + left), left})
        if (norm(own.centre_at(time) - region_centre(ball)) + (own.radius_at(time) - own.radius) >
            double{ball.region} * unit_)
          return "H";
      if (balls_.periods().any && !(keeps_image(a) > 0.0)) return "N";
    }
    if (ball.due > ball.own || ball.second < ball.due) return "D";
    for (std::uint32_t b = 0; b < a; ++b) {
      if (!present(b)) continue;
      const Ball& other = balls_[b];
      const auto lists = [this](const Ball& one, std::uint32_t number) {
        return lists_.contains(one.list, number);
      };
      const double regions = (double{ball.region} + double{other.region}) * unit_;
      const double distance = least_distance(ball, other, std::min(ball.own, other.own));
      const bool near = distance <= regions + ball.radius + other.radius + tolerance_;
      if (ball.is(Ball::passive) && other.is(Ball::passive)) continue;
      if (claim_of(a, b) == Claim::nothing) continue;
      if (near &&
          !((ball.is(Ball::passive) || lists(ball, b)) && (other.is(Ball::passive) || lists(other, a))))
        return "N";
      if (claim_of(a, b) != Claim::meet_as_balls) continue;
      // What is due may be about this pair; it is not later than they may touch.
      const double due = std::min(ball.due, other.due);
      // Two that are in touch wait for as long as the caller has put them off.
      const double gap =
          norm(balls_.between(a, b)) - (ball.radius + other.radius) - balls_.growth(a) - balls_.growth(b);
      if (!(gap > tolerance_)) continue;
      Bound image = balls_.bound(b);
      const Vec3 way = balls_.position(b) - balls_.position(a);
      space_.move(image, balls_.between(a, b) - way, balls_.time());
      // Both times are early, by up to a hundredth, each by another part.
      const double meeting = earliest_meeting(own, image, balls_.time(), due);
      if (meeting < due - 0x1p-6 * (due - balls_.time()) - 0x1p-40 * std::abs(due)) return "D";
    }
  }
  return nullptr;
}

}  // namespace kinesphere::core
