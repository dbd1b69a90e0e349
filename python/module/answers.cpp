// Certificates as answers, and queries.
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "errors.hpp"
#include "exchange.hpp"
#include "kinesphere/certificates.hpp"
#include "kinesphere/queries.hpp"
#include "moving.hpp"
#include "shapes.hpp"
#include "threads.hpp"
#include "world.hpp"

namespace kinesphere::python {
namespace {

/// Asks question(view) with a view such as the queries of the world: view(world, probe), or without a probe,
/// for None, view(world), which answers from existing reports alone.
template <class View, class Question>
auto asked(WorldHandle& handle, const char* call, const py::object& probe, const View& view,
           const Question& question) {
  const auto turn = handle.take(call);
  if (probe.is_none()) return without_gil(handle, [&] { return question(view(handle.world)); }).value();
  Asked who(probe, call, handle.is_plane());
  return without_gil(handle, [&] { return question(view(handle.world, who.probe())); }).value();
}

constexpr auto certificates_of = [](World& world, auto&&... probe) {
  return world.certificates(std::forward<decltype(probe)>(probe)...);
};
constexpr auto queries_of = [](World& world, auto&&... probe) {
  return world.queries(std::forward<decltype(probe)>(probe)...);
};
using Certificates = World::Certificates;
using Queries = World::Queries;

py::object safe_until(WorldHandle& handle, const py::object& first, const py::object& second,
                      const py::object& distance, const py::object& probe) {
  const auto body = [](const py::object& given, const char* name) {
    return id_of(given, {"safe_until", name});
  };
  const auto answer = [&](const auto& question) {
    return py::cast(asked(handle, "safe_until", probe, certificates_of, question));
  };
  if (!distance.is_none()) {
    const auto length = distance.cast<double>();
    if (first.is_none() || second.is_none())
      refuse({"safe_until", "distance"}, "must come with two bodies",
             "there are fewer (earliest_approach() is for one)");
    const BodyId a = body(first, "first"), b = body(second, "second");
    return answer([&](const Certificates& of) { return of.safe_until(a, b, length); });
  }
  if (!second.is_none()) {
    const BodyId a = body(first, "first"), b = body(second, "second");
    return answer([&](const Certificates& of) { return of.safe_until(a, b); });
  }
  if (first.is_none()) return answer([](const Certificates& of) { return of.safe_until(); });
  const BodyId only = body(first, "first");
  return answer([&](const Certificates& of) { return of.safe_until(only); });
}

EarliestContact earliest_contact(WorldHandle& handle, const py::object& body, const py::object& probe) {
  const BodyId id = id_of(body, {"earliest_contact", "body"});
  return asked(handle, "earliest_contact", probe, certificates_of,
               [&](const Certificates& of) { return of.earliest_contact(id); });
}

EarliestApproach earliest_approach(WorldHandle& handle, const py::object& body, double distance,
                                   const py::object& probe) {
  const BodyId id = id_of(body, {"earliest_approach", "body"});
  return asked(handle, "earliest_approach", probe, certificates_of,
               [&](const Certificates& of) { return of.earliest_approach(id, distance); });
}

DistanceLimits distance_limits(WorldHandle& handle, const py::object& first, const py::object& second,
                               double time, const py::object& probe) {
  const BodyId a = id_of(first, {"distance_limits", "first"}),
               b = id_of(second, {"distance_limits", "second"});
  return asked(handle, "distance_limits", probe, certificates_of,
               [&](const Certificates& of) { return of.distance_limits(a, b, time); });
}

// Rows of the results of queries.

struct FoundRecord {
  std::int64_t body;
  bool certain;
  std::array<std::uint8_t, 7> unused;
  double lower;
  double upper;
};

// In the order of their offsets, which numpy.save() requires.
constexpr Field found_fields[] = {{"body", "i8", offsetof(FoundRecord, body)},
                                  {"certain", "?", offsetof(FoundRecord, certain)},
                                  {"lower", "f8", offsetof(FoundRecord, lower)},
                                  {"upper", "f8", offsetof(FoundRecord, upper)}};

/// Overlaps have no limits of a distance.
template <class Hit>
constexpr bool has_limits = !std::is_same_v<Hit, OverlapHit>;

template <class Hit>
FoundRecord found_record_of(const Hit& hit) {
  FoundRecord record{number_of(hit.body), hit.certainty == Certainty::certainly, {}, 0.0, 0.0};
  if constexpr (has_limits<Hit>) {
    record.lower = hit.lower;
    record.upper = hit.upper;
  }
  return record;
}

template <class Hit>
py::object found_table(const std::vector<Hit>& found) {
  const std::span<const Field> fields(found_fields);
  return table_of_records<FoundRecord>(has_limits<Hit> ? fields : fields.first(2), found.size(),
                                       [&](std::size_t k) { return found_record_of(found[k]); });
}

py::object overlapping(WorldHandle& handle, const py::object& centre, double radius,
                       const py::object& probe) {
  const Vec3 middle = vector_of(centre, {"overlapping", "centre"}, handle.is_plane());
  return found_table(asked(handle, "overlapping", probe, queries_of,
                           [&](const Queries& of) { return of.overlapping(middle, radius); }));
}

py::object overlapping_box(WorldHandle& handle, const py::object& given, const py::object& probe) {
  const Argument argument{"overlapping_box", "box"};
  const auto box = box_of(given, argument, handle.is_plane());
  if (!box) throw py::type_error("overlapping_box: box must be a Box or two corners, but is None");
  return found_table(asked(handle, "overlapping_box", probe, queries_of,
                           [&](const Queries& of) { return of.overlapping(*box); }));
}

py::object nearest(WorldHandle& handle, const py::object& point, std::size_t count, const py::object& probe) {
  const Vec3 from = vector_of(point, {"nearest", "point"}, handle.is_plane());
  return found_table(asked(handle, "nearest", probe, queries_of,
                           [&](const Queries& of) { return of.nearest(from, count); }));
}

py::object ray_cast(WorldHandle& handle, const py::object& origin, const py::object& direction, double length,
                    const py::object& probe) {
  const Vec3 from = vector_of(origin, {"ray_cast", "origin"}, handle.is_plane());
  const Vec3 towards = vector_of(direction, {"ray_cast", "direction"}, handle.is_plane());
  return found_table(asked(handle, "ray_cast", probe, queries_of,
                           [&](const Queries& of) { return of.ray_cast(from, towards, length); }));
}

py::object sphere_cast(WorldHandle& handle, const py::object& origin, double radius,
                       const py::object& direction, double length, const py::object& probe) {
  const Vec3 from = vector_of(origin, {"sphere_cast", "origin"}, handle.is_plane());
  const Vec3 towards = vector_of(direction, {"sphere_cast", "direction"}, handle.is_plane());
  return found_table(asked(handle, "sphere_cast", probe, queries_of,
                           [&](const Queries& of) { return of.sphere_cast(from, radius, towards, length); }));
}

// Many queries at once.

struct FoundByQueryRecord {
  std::int64_t query;
  FoundRecord found;
};

constexpr Field found_by_query_fields[] = {
    {"query", "i8", offsetof(FoundByQueryRecord, query)},
    {"body", "i8", offsetof(FoundByQueryRecord, found) + offsetof(FoundRecord, body)},
    {"certain", "?", offsetof(FoundByQueryRecord, found) + offsetof(FoundRecord, certain)},
    {"lower", "f8", offsetof(FoundByQueryRecord, found) + offsetof(FoundRecord, lower)},
    {"upper", "f8", offsetof(FoundByQueryRecord, found) + offsetof(FoundRecord, upper)}};

template <class Hit>
py::object found_table(const HitLists<Hit>& lists) {
  const std::span<const Field> fields(found_by_query_fields);
  NewArray table{{lists.hits.size()},
                 row_type(has_limits<Hit> ? fields : fields.first(3), sizeof(FoundByQueryRecord)),
                 sizeof(FoundByQueryRecord)};
  std::size_t row = 0;
  for (std::size_t query = 0; query < lists.size(); ++query)
    for (const Hit& hit : lists[query])
      table.data<FoundByQueryRecord>()[row++] = {static_cast<std::int64_t>(query), found_record_of(hit)};
  return table.take();
}

/// What all calls for many queries take, besides the queries.
struct ManyOptions {
  const py::object& without;
  const py::object& mask;
  std::uint64_t category;
  const py::object& probe;
  const py::object& threads;

  std::optional<Filter> filter() const {
    if (mask.is_none()) return std::nullopt;
    return Filter{.category = category, .mask = mask.cast<std::uint64_t>()};
  }
  /// Returns the body that each query leaves out.
  std::vector<BodyId> left_out(const char* call, std::size_t queries) const {
    if (without.is_none()) return std::vector<BodyId>(queries, no_body);
    const Ids named = ids_of(without, {call, "without"});
    if (named.is_single) return std::vector<BodyId>(queries, named.ids.front());
    if (named.ids.size() != queries)
      refuse({call, "without"}, "must have an id for each of the " + std::to_string(queries) + " queries",
             std::to_string(named.ids.size()));
    return named.ids;
  }
  /// Returns the table of what ask(queries, workers) finds.
  py::object table(WorldHandle& handle, const char* call, const auto& ask) const {
    Threads shared(threads);
    return found_table(
        asked(handle, call, probe, queries_of, [&](const Queries& of) { return ask(of, shared.workers()); }));
  }
};

py::object overlapping_all(WorldHandle& handle, const py::object& centres, const py::object& radii,
                           const py::object& without, std::uint64_t category, const py::object& mask,
                           const py::object& probe, const py::object& threads) {
  const char* const call = "overlapping_all";
  const ManyOptions options{without, mask, category, probe, threads};
  const std::vector<Vec3> middles = vectors_of(centres, {call, "centres"}, handle.is_plane());
  const std::vector<double> sizes = each_of(radii, {call, "radii"}, middles.size());
  const std::vector<BodyId> except = options.left_out(call, middles.size());
  std::vector<SphereQuery> spheres;
  for (std::size_t k = 0; k < middles.size(); ++k) spheres.push_back({middles[k], sizes[k], except[k]});
  return options.table(handle, call, [&](const Queries& of, Workers* workers) {
    return of.overlapping_all(spheres, options.filter(), workers);
  });
}

py::object nearest_all(WorldHandle& handle, const py::object& points, std::size_t count,
                       const py::object& without, std::uint64_t category, const py::object& mask,
                       const py::object& probe, const py::object& threads) {
  const char* const call = "nearest_all";
  const ManyOptions options{without, mask, category, probe, threads};
  const std::vector<Vec3> places = vectors_of(points, {call, "points"}, handle.is_plane());
  const std::vector<BodyId> except = options.left_out(call, places.size());
  std::vector<PointQuery> all;
  for (std::size_t k = 0; k < places.size(); ++k) all.push_back({places[k], except[k]});
  return options.table(handle, call, [&](const Queries& of, Workers* workers) {
    return of.nearest_all(all, count, options.filter(), workers);
  });
}

py::object ray_cast_all(WorldHandle& handle, const py::object& origins, const py::object& directions,
                        const py::object& lengths, const py::object& radii, const py::object& without,
                        std::uint64_t category, const py::object& mask, const py::object& probe,
                        const py::object& threads) {
  const char* const call = "ray_cast_all";
  const ManyOptions options{without, mask, category, probe, threads};
  const std::vector<Vec3> from = vectors_of(origins, {call, "origins"}, handle.is_plane());
  const std::vector<Vec3> towards =
      vectors_of(directions, {call, "directions"}, handle.is_plane(), from.size());
  const std::vector<double> ways = each_of(lengths, {call, "lengths"}, from.size());
  const std::vector<double> sizes = each_of(radii, {call, "radii"}, from.size());
  const std::vector<BodyId> except = options.left_out(call, from.size());
  std::vector<RayQuery> rays;
  for (std::size_t k = 0; k < from.size(); ++k)
    rays.push_back({from[k], towards[k], ways[k], sizes[k], except[k]});
  return options.table(handle, call, [&](const Queries& of, Workers* workers) {
    return of.ray_cast_all(rays, options.filter(), workers);
  });
}

template <class Result>
py::object partner_of(const Result& result) {
  return object_of(result.partner);
}
template <class Result>
py::object wall_of(const Result& result) {
  return object_of_field(result.wall);
}

void bind_results(py::module_& module) {
  py::class_<SafeTime>(module, "SafeTime", "No contact begins before `time`.")
      .def_readonly("time", &SafeTime::time, "From now to infinity.")
      .def_readonly("touching", &SafeTime::touching, "Something touches now: `time` is now.")
      .def_readonly("probed", &SafeTime::probed)
      .def("__repr__", repr_of_parts("time", "touching", "probed"));
  py::class_<SafeSeparation>(module, "SafeSeparation",
                             "No two surfaces are within the distance before `time`.")
      .def_readonly("time", &SafeSeparation::time)
      .def_readonly("within", &SafeSeparation::within, "They certainly are within the distance now.")
      .def_readonly("probed", &SafeSeparation::probed)
      .def("__repr__", repr_of_parts("time", "within", "probed"));
  py::class_<EarliestContact>(module, "EarliestContact", "The first contact that a body may come to.")
      .def_readonly("time", &EarliestContact::time, "Infinite when there can be none.")
      .def_property_readonly("partner", partner_of<EarliestContact>)
      .def_property_readonly("wall", wall_of<EarliestContact>)
      .def_readonly("touching", &EarliestContact::touching)
      .def_readonly("probed", &EarliestContact::probed)
      .def("__repr__", repr_of_parts("time", "partner", "wall", "touching", "probed"));
  py::class_<EarliestApproach>(module, "EarliestApproach",
                               "The first time at which something may be within a distance of a body.")
      .def_readonly("time", &EarliestApproach::time)
      .def_property_readonly("partner", partner_of<EarliestApproach>)
      .def_property_readonly("wall", wall_of<EarliestApproach>)
      .def_readonly("within", &EarliestApproach::within)
      .def_readonly("probed", &EarliestApproach::probed)
      .def("__repr__", repr_of_parts("time", "partner", "wall", "within", "probed"));
  py::class_<DistanceLimits>(
      module, "DistanceLimits",
      "The distance between two surfaces (negative when they overlap) lies in [lower, upper].")
      .def_readonly("lower", &DistanceLimits::lower)
      .def_readonly("upper", &DistanceLimits::upper)
      .def_readonly("probed", &DistanceLimits::probed)
      .def("__repr__", repr_of_parts("lower", "upper", "probed"));
}

}  // namespace

void bind_answers(py::module_& module, WorldClass& world) {
  bind_results(module);
  const auto no_probe = py::arg("probe") = py::none();
  world
      .def("safe_until", safe_until, py::arg("first") = py::none(), py::arg("second") = py::none(),
           py::arg("distance") = py::none(), no_probe,
           R"(Until when it is certain that nothing begins to touch: anything; a body; two bodies.

With two bodies and a distance (length): until when their surfaces stay further apart than that. With a
probe the answer is as late as fresh reports allow; without one it costs no report. It holds until somebody
changes a velocity or adds something. Returns a SafeTime, or with a distance a SafeSeparation. Cost: O(n).)")
      .def("earliest_contact", earliest_contact, py::arg("body"), no_probe,
           "As safe_until(body), naming the partner or wall that may come first. Cost: O(n).")
      .def("earliest_approach", earliest_approach, py::arg("body"), py::arg("distance"), no_probe,
           "Who may be the first within this distance (length) of the body, and when at the earliest. Cost: "
           "O(n).")
      .def("distance_limits", distance_limits, py::arg("first"), py::arg("second"), py::arg("time"), no_probe,
           "How far apart the surfaces of two bodies are at `time` >= now, at least and at most. Cost: O(1).")
      .def("overlapping", overlapping, py::arg("centre"), py::arg("radius"), no_probe,
           R"(The bodies that may overlap a sphere now: a structured array with the fields body and certain.

Who is left out certainly does not. With a probe those in doubt are asked.)")
      .def("overlapping_box", overlapping_box, py::arg("box"), no_probe, "As overlapping(), for a Box.")
      .def("nearest", nearest, py::arg("point"), py::arg("count"), no_probe,
           R"(All bodies that may be among the `count` nearest to a point: fields body, certain, lower, upper.

Their surfaces are between lower and upper (length) away.)")
      .def("ray_cast", ray_cast, py::arg("origin"), py::arg("direction"), py::arg("length"), no_probe,
           "All bodies that may be the first on the way; fields as in nearest(), lengths along the way.")
      .def("sphere_cast", sphere_cast, py::arg("origin"), py::arg("radius"), py::arg("direction"),
           py::arg("length"), no_probe, "As ray_cast(), for a sphere of this radius.")
      .def("overlapping_all", overlapping_all, py::arg("centres"), py::arg("radii"), py::kw_only(),
           py::arg("without") = py::none(), py::arg("category") = 1, py::arg("mask") = py::none(), no_probe,
           py::arg("threads") = 1,
           R"(overlapping(), for many spheres at once: a table with the fields query, body and certain.

without: the body that each query leaves out, or one for all. mask, category: only bodies that a body with
this filter may touch (set_filter()). One call of the probe serves all queries. threads: how many share them,
or Workers; the result is the same.)")
      .def("nearest_all", nearest_all, py::arg("points"), py::arg("count"), py::kw_only(),
           py::arg("without") = py::none(), py::arg("category") = 1, py::arg("mask") = py::none(), no_probe,
           py::arg("threads") = 1,
           R"(nearest(), for many points at once; fields query, body, certain, lower, upper.

The other arguments are those of overlapping_all().)")
      .def("ray_cast_all", ray_cast_all, py::arg("origins"), py::arg("directions"), py::arg("lengths"),
           py::arg("radii") = 0.0, py::kw_only(), py::arg("without") = py::none(), py::arg("category") = 1,
           py::arg("mask") = py::none(), no_probe, py::arg("threads") = 1,
           R"(ray_cast() or, with radii > 0, sphere_cast(), for many rays at once; fields as of nearest_all().

The other arguments are those of overlapping_all().)");
}

}  // namespace kinesphere::python
