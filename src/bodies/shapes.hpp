// Shapes stores the shapes of bodies, at rest and carried.
#pragma once

#include "bodies/record_pool.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

class Shapes : public RecordPool<Shape> {
 public:
  /// Returns the shape of a body that has one.
  const Shape& of(const Body& body) const { return (*this)[body]; }
  /// Gives a body a shape at rest, or one that it carries.
  void add(Body& body, const Shape& shape, bool carried) {
    body.carries_shape = carried;
    RecordPool::add(body, shape);
  }
  /// Removes the shape of a body that is being removed, if it has one.
  void remove(const Body& body) {
    if (body.has_shape()) RecordPool::remove(body);
  }
  bool is_valid(const BodyTable& bodies) const {
    return RecordPool::is_valid(bodies, [](const Body& body) { return body.has_shape(); });
  }
};

}  // namespace kinesphere
