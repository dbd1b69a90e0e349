// The shapes of fixed bodies: Body::shape_number is a place in their table.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/body_table.hpp"
#include "kinesphere/shape.hpp"

namespace kinesphere {

class Shapes {
 public:
  /// There never was a fixed body.
  bool empty() const { return shapes_.empty(); }
  /// There is a fixed body now.
  bool any() const { return shapes_.size() > free_.size(); }
  /// Of a fixed body.
  const Shape& of(const Body& body) const { return shapes_[body.shape_number]; }
  void add(Body& body, const Shape& shape) {
    if (free_.empty()) {
      body.shape_number = static_cast<std::uint32_t>(shapes_.size());
      shapes_.push_back(shape);
    } else {
      body.shape_number = free_.back();
      free_.pop_back();
      shapes_[body.shape_number] = shape;
    }
  }
  /// Of a body that goes.
  void remove(const Body& body) {
    if (body.is_static()) free_.push_back(body.shape_number);
  }

  /// Of one that was read: each shape belongs to one body or is free.
  bool is_valid(const BodyTable& bodies) const;
  template <class Self, class Archive>
  static void serialize(Self& self, Archive& archive) {
    auto& [shapes, free] = self;
    archive(shapes, free);
  }

 private:
  std::vector<Shape> shapes_;
  std::vector<std::uint32_t> free_;
};

}  // namespace kinesphere
