#include "contact/pair_notes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace kinesphere {

bool PairNotes::has_turned(std::uint32_t body) const {
  const auto notes = of(body);
  return std::any_of(notes.begin(), notes.end(), [](const auto& each) { return each.is_turned(); });
}

void PairNotes::set_state(std::uint32_t a, std::uint32_t b, std::int32_t state) {
  PairNote note = between(a, b);
  note.state = state;
  keep(a, note);
}

void PairNotes::set_turned(std::uint32_t a, std::uint32_t b, std::optional<double> distance) {
  PairNote note = between(a, b);
  note.turned_at = distance.value_or(-1.0);
  keep(a, note);
}

void PairNotes::set_of(std::uint32_t body, std::vector<PairNote> notes) {
  if (notes.empty() && body >= lists_.size()) return;
  if (body >= lists_.size()) lists_.resize(body + std::size_t{1});
  lists_[body] = std::move(notes);
}

void PairNotes::forget_turns(std::uint32_t body) {
  const std::vector<PairNote> notes(of(body).begin(), of(body).end());
  for (const PairNote& note : notes) set_turned(body, note.partner, std::nullopt);
}

void PairNotes::forget(std::uint32_t body) {
  const std::vector<PairNote> notes(of(body).begin(), of(body).end());
  for (const PairNote& note : notes) keep(body, {note.partner});
}

/// Keeps a note of body `a` and its partner with both of them.
void PairNotes::keep(std::uint32_t a, const PairNote& note) {
  keep_half(a, note);
  keep_half(note.partner, {a, note.state, note.turned_at});
}

void PairNotes::keep_half(std::uint32_t body, const PairNote& note) {
  const bool is_empty = note.state == 0 && !note.is_turned();
  if (body >= lists_.size()) {
    if (is_empty) return;
    lists_.resize(body + std::size_t{1});
  }
  std::vector<PairNote>& list = lists_[body];
  const auto place = std::find_if(list.begin(), list.end(),
                                  [&](const PairNote& each) { return each.partner == note.partner; });
  if (is_empty) {
    if (place != list.end()) list.erase(place);
  } else if (place != list.end()) {
    *place = note;
  } else {
    list.push_back(note);
  }
}

bool PairNotes::is_valid(std::size_t bodies) const {
  if (lists_.size() > bodies) return false;
  for (std::uint32_t body = 0; body < lists_.size(); ++body) {
    for (const PairNote& note : lists_[body]) {
      if (note.partner == body || (note.state == 0 && !note.is_turned())) return false;
      if (std::isnan(note.turned_at)) return false;
      if (find(body, note.partner) != &note) return false;  // it is there twice
      const PairNote* const back = find(note.partner, body);
      if (back == nullptr || back->state != note.state || back->turned_at != note.turned_at) return false;
    }
  }
  return true;
}

}  // namespace kinesphere
