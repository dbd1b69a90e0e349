// What a world keeps, whoever moves it on.
#pragma once

#include "contact/contact_book.hpp"
#include "engine/room.hpp"
#include "window/tempo.hpp"
#include "window/windows.hpp"

namespace kinesphere {

struct Tables {
  explicit Tables(const WorldDefinition& definition)
      : bodies(definition),
        book(definition),
        windows(bodies.space()),
        tempo(longest_way(bodies.definition()), definition.dimensions) {}

  Bodies bodies;
  ContactBook book;
  Windows windows;
  Tempo tempo;
};

}  // namespace kinesphere
