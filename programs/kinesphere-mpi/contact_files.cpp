#include "contact_files.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace kinesphere::program {

ContactFiles::ContactFiles(const Ranks& ranks, const ContactOptions& options, bool is_resumable,
                           const Lengths& kept)
    : ranks_(ranks), output_(options.output) {
  if (output_ == ContactOutput::none) return;
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const auto count = static_cast<std::size_t>(ranks.count());
  const bool is_one = output_ == ContactOutput::one_file;
  file_count_ = is_one ? 1 : std::max(kept.size(), count);
  ranks.together(1, [&] {
    for (std::size_t place = rank; place < file_count_; place += count) {
      OutputPlace file{is_one ? options.path : fmt::format("{}.{}", options.path, place)};
      if (is_resumable) file.resumed_at = place < kept.size() ? kept[place] : 0;
      files_.push_back({place, std::make_unique<ContactLog>(table_format_of(options.path), file)});
    }
  });
}

void ContactFiles::note(const OrderedEvent& event) {
  if (output_ == ContactOutput::file_per_rank) files_.front().log->write(event.event);
  if (output_ == ContactOutput::one_file) noted_.push_back(event);
}

void ContactFiles::write_noted() {
  if (output_ != ContactOutput::one_file) return;
  ranks_.merge(noted_, [this](const Event& event) { files_.front().log->write(event); });
  noted_.clear();
}

ContactFiles::Lengths ContactFiles::sync() {
  write_noted();
  Lengths lengths(file_count_);
  ranks_.together(1, [&] {
    for (const File& file : files_) lengths[file.place] = file.log->sync();
  });
  ranks_.sum(lengths);
  return lengths;
}

void ContactFiles::commit() {
  write_noted();
  ranks_.together(1, [&] {
    for (const File& file : files_) file.log->commit();
  });
}

}  // namespace kinesphere::program
