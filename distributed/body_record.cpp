#include "distributed/body_record.hpp"

#include <utility>

namespace kinesphere {

BodyRecord record_of(const Bodies& bodies, const ContactGraph& contacts, std::uint32_t number) {
  const auto name_of = [&](std::uint32_t other) { return bodies.table().name_of(other); };
  const Body& body = bodies[number];
  BodyRecord record{.name = name_of(number),
                    .body = body,
                    .image = bodies.space().repeats() ? bodies.images[number] : PeriodicImage{},
                    .filter = bodies.filters.of(number),
                    .mass = bodies.masses.of(number),
                    .radius = bodies.radii.of(number),
                    .contacts = ContactsOfBody::of(contacts, number)};
  if (body.has_shape()) record.shape.push_back(bodies.shapes.of(body));
  if (const RigidRecord* const turning = bodies.rigid.find(body)) record.rigid.push_back(*turning);
  PartnerList partners;
  for (const auto& [partner, state] : std::as_const(record).contacts.partners.all())
    partners.set({name_of(partner), state});
  record.contacts.partners = std::move(partners);
  for (OverlapRecord& overlap : record.contacts.overlaps) overlap.partner = name_of(overlap.partner);
  for (PairNote note : contacts.pairs().of(number)) {
    note.partner = name_of(note.partner);
    record.notes.push_back(note);
  }
  return record;
}

std::uint32_t install(const BodyRecord& record, Bodies& bodies, ContactGraph& contacts, double time) {
  const std::uint32_t number = bodies.add_named(BodyDefinition{}, time, record.name);
  Body& body = bodies[number];
  const std::uint32_t generation = body.generation;
  body = record.body;
  body.generation = generation;
  body.shape_number = body.change_number = body.sleep_number = Body::none;
  body.is_rigid = body.is_round = body.carries_shape = false;
  for (const Shape& shape : record.shape) bodies.give_shape(number, shape, true);
  for (const RigidRecord& rigid : record.rigid) bodies.make_rigid(number, rigid);
  bodies.filters.keep(number, record.filter);
  bodies.masses.keep(number, record.mass);
  bodies.radii.keep(number, record.radius);
  bodies.set_solid(number, body.solid);
  if (bodies.space().repeats()) bodies.images[number] = record.image;
  contacts.add(number, 0.0);
  record.contacts.set(contacts, number);
  return number;
}

}  // namespace kinesphere
