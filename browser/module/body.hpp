// Bodies, filters and shapes in tables of numbers.
#pragma once

#include <cstddef>

#include "kinesphere/kinesphere.hpp"

namespace kinesphere::browser {

/// Size of a body in numbers; putBody() in package/src/body.ts writes them.
constexpr std::size_t body_numbers = 21;
BodyDefinition body_at(const double* numbers);

/// `kind` and numbers are those of shapeNumbers() in package/src/body.ts. Errors: those of Mesh::create() and
/// Mesh::chain().
Result<Shape> shape_at(int kind, const double* numbers);

/// Category, mask and group; -1 is the mask of all.
Filter filter_at(const double* numbers);
void put(const Filter& filter, double* numbers);
std::uint64_t mask_of(double number);

}  // namespace kinesphere::browser
