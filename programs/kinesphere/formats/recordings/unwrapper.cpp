// Undoes the jumps of positions at the faces of a periodic box.
#include "formats/recordings/unwrapper.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/number_text.hpp"

namespace kinesphere::program {

void Unwrapper::add_row(RowTable& table, std::size_t line, const std::string& id, std::string_view time,
                        const std::array<std::string_view, 3>& position) {
  const auto add_as_it_is = [&] { table.add_row(line, id, time, position[0], position[1], position[2]); };
  if (!is_periodic()) return add_as_it_is();
  std::array<double, 3> place{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto number = parse_number(position[axis]);
    if (!number) return add_as_it_is();
    place[axis] = *number;
  }
  const auto [last, is_new] = last_.try_emplace(id, place);
  bool has_jumped = false;
  // The last vector alone has a part along z, the first none but along x.
  for (std::size_t k = 3; !is_new && k-- > 0;) {
    const auto& vector = cell_[k];
    if (!(vector[k] > 0.0)) continue;
    const double jumps = std::round((place[k] - last->second[k]) / vector[k]);
    has_jumped = has_jumped || jumps != 0.0;
    for (std::size_t axis = 0; axis <= k; ++axis) place[axis] -= jumps * vector[axis];
  }
  last->second = place;
  if (!has_jumped) return add_as_it_is();
  table.add_row(line, id, time, place[0], place[1], place[2]);
}

std::string Unwrapper::warning(const std::string& file) {
  return fmt::format(
      "{}: its box is periodic: tracks go on through its faces, but distances through them are not seen",
      file);
}

}  // namespace kinesphere::program
