// Cuts text into records.
#include "formats/tables/record_cutter.hpp"

#include <algorithm>

#include "base/ascii_text.hpp"
#include "formats/tables/row_splitter.hpp"

namespace kinesphere::program {
namespace {

bool is_json_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

}  // namespace

void RecordCutter::feed(std::string_view text) {
  // Drops the text that has been cut once it is more than half.
  if (begin_ > text_.size() / 2) {
    text_.erase(0, begin_);
    at_ -= begin_;
    begin_ = 0;
  }
  text_.append(text);
}

std::optional<Record> RecordCutter::next() {
  switch (kind_) {
    case Kind::lines:
      return next_line();
    case Kind::rows:
      return next_row();
    case Kind::documents:
      return next_document();
    case Kind::whole:
      break;
  }
  return std::nullopt;
}

Record RecordCutter::cut(std::size_t end, std::size_t next, bool is_whole) {
  const Record record{std::string_view(text_).substr(begin_, end - begin_), line_, is_whole,
                      text_.size() - begin_};
  line_ += static_cast<std::size_t>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(begin_),
                                               text_.begin() + static_cast<std::ptrdiff_t>(next), '\n'));
  begin_ = at_ = next;
  return record;
}

std::optional<Record> RecordCutter::next_line() {
  for (;;) {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string::npos) {
      at_ = text_.size();
      if (skips_line_) {
        begin_ = at_;
      } else if (at_ - begin_ > longest_line) {
        skips_line_ = true;
        return Record{std::string_view(text_).substr(begin_, 80), line_, false, at_ - begin_};
      }
      return std::nullopt;
    }
    at_ = end + 1;
    const std::size_t begin = begin_, line = line_;
    begin_ = at_;
    ++line_;
    if (skips_line_) {
      skips_line_ = false;
      continue;
    }
    std::string_view text = std::string_view(text_).substr(begin, end - begin);
    if (text.ends_with('\r')) text.remove_suffix(1);
    return Record{text, line, text.size() <= longest_line, text_.size() - begin};
  }
}

std::optional<Record> RecordCutter::next_row() {
  for (;;) {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string::npos) return std::nullopt;
    const std::string_view line = std::string_view(text_).substr(at_, end - at_);
    const std::string_view content = trimmed(line);
    if (at_ > begin_ || !(content.empty() || content.starts_with('#'))) {
      if (has_quotes_.value_or(true) && std::count(line.begin(), line.end(), '"') % 2 == 1)
        in_text_ = !in_text_;
      // The first row shows the separator.
      if (!in_text_ && !has_quotes_)
        has_quotes_ = separator_of(std::string_view(text_).substr(begin_, end - begin_)) != ' ';
    }
    at_ = end + 1;
    if (in_text_) continue;
    Record record = cut(end, end + 1);
    if (record.text.ends_with('\r')) record.text.remove_suffix(1);
    return record;
  }
}

bool RecordCutter::begins_document(std::size_t at, bool& unknown) const {
  const auto skip_blanks = [&] {
    while (at < text_.size() && (text_[at] == ' ' || text_[at] == '\t')) ++at;
  };
  skip_blanks();
  if (at < text_.size() && text_[at] != '{') return false;
  ++at;
  skip_blanks();
  const std::string_view ahead = std::string_view(text_).substr(std::min(at, text_.size()));
  for (const std::string_view key : {"\"now\"", "\"time\"", "\"ac\"", "\"aircraft\""}) {
    if (ahead.starts_with(key)) return true;
    if (key.starts_with(ahead)) unknown = true;
  }
  return false;
}

std::optional<Record> RecordCutter::next_document() {
  while (at_ < text_.size()) {
    const char c = text_[at_];
    if (depth_ == 0) {
      if (c != '{' && begin_ == at_ && is_json_blank(c)) {
        cut(at_ + 1, at_ + 1);
        continue;
      }
      if (c == '{' && begin_ == at_) {
        depth_ = 1;
        ++at_;
        continue;
      }
      // Text outside a document is skipped until its line ends or a document begins.
      if (c == '\n' || c == '{') return cut(at_, at_);
      ++at_;
      continue;
    }
    if (c == '\n') {
      bool unknown = false;
      const bool begins = begins_document(at_ + 1, unknown);
      if (in_text_ || begins) {
        depth_ = 0;
        in_text_ = escaped_ = false;
        return cut(at_, at_ + 1, false);
      }
      if (unknown) return std::nullopt;
      ++at_;
      continue;
    }
    ++at_;
    if (escaped_) {
      escaped_ = false;
    } else if (c == '"') {
      in_text_ = !in_text_;
    } else if (in_text_) {
      escaped_ = c == '\\';
    } else if (c == '{' || c == '[') {
      ++depth_;
    } else if ((c == '}' || c == ']') && --depth_ == 0) {
      return cut(at_, at_);
    }
    if (at_ - begin_ > longest_document) {
      depth_ = 0;
      in_text_ = escaped_ = false;
      return cut(at_, at_, false);
    }
  }
  return std::nullopt;
}

std::optional<Record> RecordCutter::rest() {
  if (skips_line_) begin_ = at_ = text_.size();
  skips_line_ = false;
  if (begin_ == text_.size()) return std::nullopt;
  const bool is_whole = kind_ != Kind::documents;
  Record record = cut(text_.size(), text_.size(), is_whole);
  if (record.text.ends_with('\r')) record.text.remove_suffix(1);
  depth_ = 0;
  in_text_ = escaped_ = false;
  if (std::all_of(record.text.begin(), record.text.end(), is_json_blank)) return std::nullopt;
  return record;
}

}  // namespace kinesphere::program
