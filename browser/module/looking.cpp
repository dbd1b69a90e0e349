// Reading a world beyond what C tells: definitions, bounds, shapes, counters, certificates and defects; and
// queries with a box, at which bodies they look.
#include <string>

#include "c/probing.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/inspection.hpp"
#include "kinesphere/queries.hpp"
#include "module.hpp"

namespace kinesphere::browser {
namespace {

void put(std::initializer_list<double> numbers) { answer().insert(answer().end(), numbers); }
void put(const Vec3& vector) { put({vector.x, vector.y, vector.z}); }

Result<RigidBody> rigid_of(const World& world, BodyId body) {
  const auto view = world.body(body);
  if (!view) return view.error();
  if (view->rigid) return *view->rigid;
  return Error{ErrorCode::unsupported, "body", body,
               "body must be rigid, but body " + to_string(body) + " is not"};
}

/// Answers by look(world) what it puts.
template <class Look>
ks_status answering(ks_world world, const Look& look) {
  answer().clear();
  return c::reading("world", world, [&](const c::WorldObject& object) { look(object.world()); });
}

}  // namespace

KINESPHERE_EXPORT(world_definition)
ks_status world_definition(ks_world world, ks_world_definition* definition) {
  return c::reading("world", world, [&](const c::WorldObject& object) {
    *definition = c::c_world(object.world().definition());
  });
}

/// What the world knows of a body, the bound that contains it now, and whether it is rigid.
struct BoundedView {
  ks_body_view view;
  Vec3 centre;
  double bound_radius;
  double is_rigid;
};
KINESPHERE_EXPORT(world_views)
ks_status world_views(ks_world world, std::size_t count, const BodyId* bodies, BoundedView* views) {
  return c::reading("world", world, [&](const c::WorldObject& object) {
    const double now = object.world().time();
    for (std::size_t k = 0; k < count; ++k) {
      const BodyView view = object.world().body(bodies[k]).value();
      views[k] = {c::c_view(view), view.bound.centre_at(now),
                  view.is_static ? view.definition.radius : view.bound.radius_at(now),
                  view.rigid ? 1.0 : 0.0};
    }
  });
}

/// Answers the place of a body's shape among those of ks_shape, and its numbers: those of the points and
/// `number`; of a mesh the counts of vertices and triangles, and both.
KINESPHERE_EXPORT(world_shape_of) ks_status world_shape_of(ks_world world, const BodyId* body) {
  return answering(world, [&](const World& of) {
    const Shape shape = of.body(*body).value().shape;
    put({static_cast<double>(shape.index())});
    if (const auto* ball = std::get_if<Ball>(&shape)) {
      put(ball->centre);
      put({ball->radius});
    } else if (const auto* side = std::get_if<HalfSpace>(&shape)) {
      put(side->normal);
      put({side->offset});
    } else if (const auto* box = std::get_if<Box>(&shape)) {
      put(box->lower);
      put(box->upper);
    } else if (const auto* triangle = std::get_if<Triangle>(&shape)) {
      for (const Vec3& corner : {triangle->a, triangle->b, triangle->c}) put(corner);
    } else if (const auto* mesh = std::get_if<Mesh>(&shape)) {
      put({static_cast<double>(mesh->vertices().size()), static_cast<double>(mesh->size())});
      for (const Vec3& vertex : mesh->vertices()) put(vertex);
      for (const auto& corners : mesh->corners())
        answer().insert(answer().end(), corners.begin(), corners.end());
    }
  });
}
/// Answers for each part of a rigid body its radius, the number of its points, and these.
KINESPHERE_EXPORT(world_parts_of) ks_status world_parts_of(ks_world world, const BodyId* body) {
  return answering(world, [&](const World& of) {
    for (const auto& [a, b, radius, more] : rigid_of(of, *body).value().parts) {
      put({radius, static_cast<double>(2 + more.size())});
      put(a);
      put(b);
      for (const Vec3& point : more) put(point);
    }
  });
}

/// Answers the numbers of events by kind, and of the work.
KINESPHERE_EXPORT(world_counters) ks_status world_counters(ks_world world) {
  return answering(world, [&](const World& of) {
    const Counters& counters = of.counters();
    for (const std::uint64_t events : counters.events) put({static_cast<double>(events)});
    for (const std::uint64_t count :
         {counters.probes, counters.window_ends, counters.starts, counters.restarts, counters.pair_checks,
          counters.wall_checks, counters.searches, counters.candidates, counters.hot_pairs,
          counters.certificates, counters.zeno_steps, counters.repeated_contacts, counters.jammed_contacts})
      put({static_cast<double>(count)});
  });
}
/// Answers triples of two bodies and a time.
KINESPHERE_EXPORT(world_certificates) ks_status world_certificates(ks_world world) {
  return answering(world, [&](const World& of) {
    for (const auto& [first, second, until] : of.inspection().certificates())
      put({number_of(first), number_of(second), until});
  });
}
/// Answers boxes (6 numbers) with their number of bodies.
KINESPHERE_EXPORT(world_cells) ks_status world_cells(ks_world world) {
  return answering(world, [&](const World& of) {
    for (const auto& [box, bodies] : of.inspection().cells()) {
      put(box.lower);
      put(box.upper);
      put({static_cast<double>(bodies)});
    }
  });
}
/// Writes the address of a text that is valid until the next audit: the first defect, or empty.
KINESPHERE_EXPORT(world_audit) ks_status world_audit(ks_world world, const char** defect) {
  static std::string text;
  return c::reading("world", world, [&](const c::WorldObject& object) {
    const auto finding = object.world().inspection().audit();
    text = finding ? finding->where + ": " + finding->what : "";
    *defect = text.c_str();
  });
}

/// Calls ask(world) or, with a probe, ask(world, probe).
template <class Ask>
ks_status asking(ks_world world, ks_probe probe, void* user, const Ask& ask) {
  if (probe == nullptr)
    return c::reading("world", world, [&](const c::WorldObject& object) { ask(object.world()); });
  return c::changing("world", world, [&](c::WorldObject& object) {
    c::with_probe("world", object.simulation(), probe, user,
                  [&](const Probe& combined) { ask(object.world(), combined); });
  });
}

/// As ks_world_overlapping_box(), without the body `except`, and those that `filter`, if not null, excludes.
/// Answers two numbers for each hit: the body, and 1 if certain.
KINESPHERE_EXPORT(world_overlapping_box)
ks_status world_overlapping_box(ks_world world, const Box* box, const BodyId* except, const ks_filter* filter,
                                ks_probe probe, void* user) {
  QueryOptions options{.except = *except};
  if (filter != nullptr) options.filter = c::filter_of(*filter);
  answer().clear();
  return asking(world, probe, user, [&](auto& of, const auto&... probes) {
    for (const auto& [body, certainty] : of.queries(probes...).overlapping(*box, options).value())
      put({number_of(body), certainty == Certainty::certainly ? 1.0 : 0.0});
  });
}
/// Writes a time before which no contact of the two bodies begins.
KINESPHERE_EXPORT(world_pair_safe_until)
ks_status world_pair_safe_until(ks_world world, const BodyId* first, const BodyId* second, ks_probe probe,
                                void* user, double* time) {
  return asking(world, probe, user, [&](auto& of, const auto&... probes) {
    *time = of.certificates(probes...).safe_until(*first, *second).value().time;
  });
}

}  // namespace kinesphere::browser
