// GPX: the points of its tracks.
#include <fmt/format.h>

#include <utility>

#include "base/program_error.hpp"
#include "formats/recordings/recording_kinds.hpp"
#include "formats/recordings/track_labels.hpp"
#include "formats/recordings/xml_elements.hpp"

namespace kinesphere::program {
namespace {

#ifdef KINESPHERE_WITH_EXPAT

class GpxReader final : XmlElements {
 public:
  explicit GpxReader(const RecordingText& recording) : XmlElements(recording, "GPX") {}

  RowTable read() {
    read_all();
    if (!has_times_)
      throw ProgramError(
          fmt::format("{}: expected tracks (trk) whose points have times, as receivers log them, but {}",
                      file(), table_.size() == 0 ? "it has no tracks" : "none has a time"));
    table_.use_heights_of_all(file());
    return std::move(table_);
  }

 private:
  enum Column : std::size_t { of_time = 1, of_height = 4 };

  void begin(std::string_view name, const char** attributes) override {
    if (name == "trk") {
      ++tracks_;
      name_ = fmt::format("track {}", tracks_);
      is_in_track_ = true;
    } else if (name == "trkpt" && is_in_track_) {
      is_in_point_ = true;
      table_.add_row(line(), name_, "", attribute(attributes, "lon"), attribute(attributes, "lat"));
    }
  }
  void end(std::string_view name) override {
    if (name == "trk") is_in_track_ = false;
    if (name == "trkpt") is_in_point_ = false;
    if (is_in_point_ && name == "ele") table_.set(of_height, content());
    if (is_in_point_ && name == "time") {
      table_.set(of_time, content());
      has_times_ = has_times_ || !content().empty();
    }
    if (is_in_track_ && !is_in_point_ && name == "name") name_ = labels_.label(content());
  }

  RowTable table_{"GPX", {"id", "time", "lon", "lat", "ele"}};
  std::string name_;
  TrackLabels labels_;
  std::size_t tracks_ = 0;
  bool is_in_track_ = false, is_in_point_ = false, has_times_ = false;
};

#endif

}  // namespace

RowTable read_gpx(const RecordingText& recording) {
#ifdef KINESPHERE_WITH_EXPAT
  return GpxReader(recording).read();
#else
  throw without_expat(recording.file, "GPX");
#endif
}

}  // namespace kinesphere::program
