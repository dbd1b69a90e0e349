// The tracks of a watch, by their ids in the stream.
#include "watch/tracks/track_names.hpp"
#include "formats/fields/wrong_input.hpp"

#include <algorithm>
#include <utility>

namespace kinesphere::program {

TrackId track_id_of(std::string_view text) {
  // FNV-1a, and the mixing of splitmix64 behind it.
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
  hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
  return hash ^ (hash >> 31);
}

const std::string& TrackNames::text(TrackId id) const {
  static const std::string none;
  const NamedTrack* const track = find(id);
  return track != nullptr ? track->text : none;
}

NamedTrack& TrackNames::add(TrackId id, std::string_view text) {
  if (numbers_.add(id, static_cast<std::uint32_t>(tracks_.size()))) tracks_.emplace_back();
  NamedTrack& track = *find(id);
  track.text.assign(text);
  return track;
}

void TrackNames::index() {
  for (std::uint32_t number = 0; number < tracks_.size(); ++number)
    if (!numbers_.add(track_id_of(tracks_[number].text), number))
      throw WrongInput("expected each track once in the snapshot");
}

void TrackNames::remove(TrackId id) {
  const std::uint32_t number = numbers_.find(id);
  if (number == IdIndex::none) return;
  numbers_.remove(id);
  if (&tracks_[number] != &tracks_.back()) {
    const TrackId last = track_id_of(tracks_.back().text);
    numbers_.remove(last);
    numbers_.add(last, number);
    tracks_[number] = std::move(tracks_.back());
  }
  tracks_.pop_back();
}

}  // namespace kinesphere::program
