// Continuous collision of FCL, as a way to find the first contact of two bodies.
#include "research/bench/shapes/pair_methods.hpp"

#ifdef KINESPHERE_WITH_FCL

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/motion/interp_motion.h>
#include <fcl/math/motion/translation_motion.h>
#include <fcl/narrowphase/continuous_collision.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace kinesphere::program {
namespace {

using FclRequest = fcl::ContinuousCollisionRequest<double>;
using FclVector = fcl::Vector3<double>;
using FclMatrix = fcl::Matrix3<double>;
using FclMotion = fcl::InterpMotion<double>;

FclVector fcl_vector(const Vec3& v) { return {v.x, v.y, v.z}; }

/// Place and orientation of a body.
struct FclPose {
  FclPose(const TurningBody& body, double time) {
    const Quaternion& q = body.rotation.orientation;
    const FclVector spin = fcl_vector(body.rotation.angular_velocity);
    const double speed = spin.norm();
    turn = fcl::Quaternion<double>(q.w, q.x, q.y, q.z).toRotationMatrix();
    if (speed > 0.0) turn = fcl::AngleAxis<double>(speed * time, spin / speed).toRotationMatrix() * turn;
    place = fcl_vector(body.start.position + body.start.velocity * time);
  }

  FclMatrix turn;
  FclVector place;
};

/// Motion of a shape with its middle at `centre` in a body that flies and turns steadily.
FclMotion motion_of(const FclPose& from, const FclPose& to, const FclVector& centre) {
  // Of the constructors this is the only one that sets all members and the velocity.
  return {from.turn, from.place + from.turn * centre, to.turn, to.place + to.turn * centre, -centre};
}

/// Shapes of FCL: one capsule along z, one box, or spheres with their centres; and the sphere around all of
/// them.
struct FclShapes {
  explicit FclShapes(const TurningBody& body) : around(reach(body)) {
    for (const RigidPart& part : body.parts) {
      if (!part.more.empty()) {
        centres.push_back(FclVector::Zero());
        parts.push_back(std::make_unique<fcl::Boxd>(fcl_vector(2.0 * half_edges(part))));
        continue;
      }
      centres.push_back(fcl_vector(0.5 * (part.a + part.b)));
      if (part.a == part.b)
        parts.push_back(std::make_unique<fcl::Sphered>(part.radius));
      else
        parts.push_back(std::make_unique<fcl::Capsuled>(part.radius, norm(part.b - part.a)));
    }
  }

  std::vector<std::unique_ptr<fcl::CollisionGeometry<double>>> parts;
  std::vector<FclVector> centres;
  fcl::Sphered around;
};

/// Returns the time of contact as a part of the motions.
template <class Motion>
std::optional<double> contact_of(const fcl::CollisionGeometry<double>& first, const Motion& first_motion,
                                 const fcl::CollisionGeometry<double>& second, const Motion& second_motion,
                                 const FclRequest& request) {
  // Conservative advancement begins where the motion stands.
  first_motion.integrate(0.0);
  second_motion.integrate(0.0);
  fcl::ContinuousCollisionResult<double> result;
  fcl::continuousCollide(&first, &first_motion, &second, &second_motion, request, result);
  return result.is_collide ? std::optional(result.time_of_contact) : std::nullopt;
}

/// Returns the first contact in a piece of the course, as a part of it. Of clusters the spheres around them
/// are tried first.
std::optional<double> contact_in_piece(const FclShapes& first, const FclPose (&first_poses)[2],
                                       const FclShapes& second, const FclPose (&second_poses)[2],
                                       const FclRequest& request) {
  const auto motions = [](const FclShapes& shapes, const FclPose(&poses)[2]) {
    std::vector<FclMotion> found;
    for (const FclVector& centre : shapes.centres) found.push_back(motion_of(poses[0], poses[1], centre));
    return found;
  };
  if (first.parts.size() * second.parts.size() > 1) {
    FclRequest nearness = request;
    nearness.ccd_solver_type = fcl::CCDC_CONSERVATIVE_ADVANCEMENT;
    const auto middle = [](const FclPose(&poses)[2]) {
      return fcl::TranslationMotion<double>(FclMatrix::Identity(), poses[0].place, poses[1].place);
    };
    const auto one = middle(first_poses), other = middle(second_poses);
    if (!contact_of(first.around, one, second.around, other, nearness)) return std::nullopt;
  }
  const std::vector<FclMotion> first_motions = motions(first, first_poses);
  const std::vector<FclMotion> second_motions = motions(second, second_poses);
  std::optional<double> earliest;
  for (std::size_t a = 0; a < first.parts.size(); ++a) {
    for (std::size_t b = 0; b < second.parts.size(); ++b) {
      const auto time =
          contact_of(*first.parts[a], first_motions[a], *second.parts[b], second_motions[b], request);
      if (time && (!earliest || *time < *earliest)) earliest = time;
    }
  }
  return earliest;
}

/// Finds the first contact piece by piece. In a piece each body makes at most a quarter turn, since motions
/// of FCL go from one orientation to the other by less than half a turn.
std::optional<double> fcl_contact(const TurningPair& pair, const FclRequest& request) {
  const double quarter = 1.57079632679489661923;
  const double fastest =
      std::max(norm(pair.first.rotation.angular_velocity), norm(pair.second.rotation.angular_velocity));
  const int pieces = std::max(1, static_cast<int>(std::ceil(fastest / quarter)));
  const FclShapes first(pair.first);
  const FclShapes second(pair.second);
  for (int piece = 0; piece < pieces; ++piece) {
    const double from = piece / static_cast<double>(pieces);
    const double to = (piece + 1) / static_cast<double>(pieces);
    const FclPose first_poses[] = {{pair.first, from}, {pair.first, to}};
    const FclPose second_poses[] = {{pair.second, from}, {pair.second, to}};
    const auto part = contact_in_piece(first, first_poses, second, second_poses, request);
    if (part) return from + (to - from) * *part;
  }
  return std::nullopt;
}

PairMethod fcl_method(std::string name, fcl::CCDSolverType solver) {
  FclRequest request;
  request.ccd_solver_type = solver;
  request.ccd_motion_type = fcl::CCDM_LINEAR;
  return {std::move(name), [=](const TurningPair& pair) { return fcl_contact(pair, request); }};
}

}  // namespace

std::vector<PairMethod> fcl_methods() {
  return {fcl_method("FCL advancement", fcl::CCDC_CONSERVATIVE_ADVANCEMENT),
          fcl_method("FCL naive", fcl::CCDC_NAIVE)};
}

}  // namespace kinesphere::program

#else

namespace kinesphere::program {

std::vector<PairMethod> fcl_methods() { return {}; }

}  // namespace kinesphere::program

#endif
