// Shapes stores the shapes of bodies, at rest and carried; Body::shape_number is an index into it.
#pragma once

#include <cstdint>
#include <vector>

#include "bodies/body_table.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

class Shapes {
 public:
  /// Returns true if there has never been a body with a shape.
  bool empty() const { return shapes_.empty(); }
  /// Returns true if there is a body with a shape now.
  bool any() const { return shapes_.size() > free_.size(); }
  /// Returns the shape of a body that has one.
  const Shape& of(const Body& body) const { return shapes_[body.shape_number]; }
  /// Gives a body a shape at rest, or one that it carries.
  void add(Body& body, const Shape& shape, bool carried) {
    body.carries_shape = carried;
    if (free_.empty()) {
      body.shape_number = static_cast<std::uint32_t>(shapes_.size());
      shapes_.push_back(shape);
    } else {
      body.shape_number = free_.back();
      free_.pop_back();
      shapes_[body.shape_number] = shape;
    }
  }
  /// Gives a body with a shape another one.
  void replace(const Body& body, const Shape& shape) { shapes_[body.shape_number] = shape; }
  /// Removes the shape of a body that is being removed, if it has one.
  void remove(const Body& body) {
    if (body.has_shape()) free_.push_back(body.shape_number);
  }

  /// Returns true if each shape belongs to one body or is free. Call after reading.
  bool is_valid(const BodyTable& bodies) const;
  static void serialize(auto& self, auto& archive) {
    auto& [shapes, free] = self;
    archive(shapes, free);
  }

 private:
  std::vector<Shape> shapes_;
  std::vector<std::uint32_t> free_;
};

}  // namespace kinesphere
