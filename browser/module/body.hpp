// Definitions, bodies, filters and shapes in tables of numbers.
#pragma once

#include <cstddef>

#include "kinesphere/kinesphere.hpp"
#include "numbers.hpp"

namespace kinesphere::browser {

/// The numbers that definitionNumbers() in package/src/definition.ts writes: the fields, and the box and the
/// filter of the walls with whether they are there.
WorldDefinition definition_at(const double* numbers);

/// Returns the package's pair filter of this number; a number below 0 stands for none.
PairFilter pair_filter_of(double filter);

/// The numbers that putBodyFields() in package/src/records.ts writes.
BodyDefinition body_at(const double* numbers);

/// `kind` and numbers are those of shapeNumbers() in package/src/body.ts. Errors: those of Mesh::create() and
/// Mesh::chain().
Result<Shape> shape_at(int kind, const double* numbers);

inline Filter filter_at(const double* numbers) { return NumberReader(numbers).take<Filter>(); }

}  // namespace kinesphere::browser
