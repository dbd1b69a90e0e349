#include "recording_commands.hpp"

#include <memory>

#include "tracks/tracks.hpp"
#include "view/view.hpp"
#include "watch/watch.hpp"

namespace kinesphere::program {

std::vector<Command> add_recording_commands(CLI::App& app) {
  const auto tracks_options = std::make_shared<TracksOptions>();
  const auto view_options = std::make_shared<ViewOptions>();
  const auto watch_options = std::make_shared<WatchOptions>();
  return {{add_tracks_command(app, *tracks_options), [=] { return tracks(*tracks_options); }},
          {add_view_command(app, *view_options), [=] { return view(*view_options); }},
          {add_watch_command(app, *watch_options), [=] { return watch(*watch_options); }}};
}

}  // namespace kinesphere::program
