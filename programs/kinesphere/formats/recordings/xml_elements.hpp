// Reads XML with expat: elements in their order.
#pragma once

#ifdef KINESPHERE_WITH_EXPAT

#include <expat.h>
#include <fmt/format.h>

#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>

#include "base/ascii_text.hpp"
#include "base/program_error.hpp"
#include "formats/recordings/recording_kinds.hpp"

namespace kinesphere::program {

/// Calls `begin` and `end` of a derived class for each element of a file.
class XmlElements {
 public:
  /// `kind` is what the file is, for messages.
  XmlElements(const RecordingText& recording, std::string_view kind)
      : text_(recording.text), file_(recording.file), kind_(kind), parser_(XML_ParserCreate(nullptr)) {
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(
        parser_.get(),
        [](void* self, const char* name, const char** attributes) {
          static_cast<XmlElements*>(self)->content_.clear();
          static_cast<XmlElements*>(self)->begin(local_name(name), attributes);
        },
        [](void* self, const char* name) { static_cast<XmlElements*>(self)->end(local_name(name)); });
    XML_SetCharacterDataHandler(parser_.get(), [](void* self, const char* text_part, int size) {
      static_cast<XmlElements*>(self)->content_.append(text_part, static_cast<std::size_t>(size));
    });
    // Entities of its own could make a small file huge.
    XML_SetEntityDeclHandler(parser_.get(), [](void* self, const char*, int, const char*, int, const char*,
                                               const char*, const char*, const char*) {
      XML_StopParser(static_cast<XmlElements*>(self)->parser_.get(), XML_FALSE);
    });
  }
  XmlElements(const XmlElements&) = delete;
  XmlElements& operator=(const XmlElements&) = delete;

  /// Reads the whole text. Throws ProgramError naming file and line.
  void read_all() {
    if (text_.size() > std::numeric_limits<int>::max())
      throw ProgramError(fmt::format("{}: expected {} of less than 2 GiB", file_, kind_));
    const XML_Status status = XML_Parse(parser_.get(), text_.data(), static_cast<int>(text_.size()), 1);
    if (!failure_.empty()) throw ProgramError(failure_);
    if (status == XML_STATUS_ERROR)
      throw ProgramError(fmt::format("{}:{}: expected {}: {}", file_, line(), kind_,
                                     XML_ErrorString(XML_GetErrorCode(parser_.get()))));
  }

 protected:
  virtual ~XmlElements() = default;

  /// `attributes` are names and values in turn, and a null pointer behind them.
  virtual void begin(std::string_view name, const char** attributes) = 0;
  virtual void end(std::string_view name) = 0;

  /// The text since the last beginning of an element, as a field of a table.
  std::string content() const { return plain(content_); }
  /// Ends the reading: read_all() throws ProgramError with this text, naming file and line.
  void fail(std::string_view text) {
    if (failure_.empty()) failure_ = fmt::format("{}:{}: {}", file_, line(), text);
    XML_StopParser(parser_.get(), XML_FALSE);
  }
  std::size_t line() const { return XML_GetCurrentLineNumber(parser_.get()); }
  const std::string& file() const { return file_; }
  /// Returns an attribute as a field of a table; empty if there is none.
  static std::string attribute(const char** attributes, std::string_view name) {
    for (; *attributes != nullptr; attributes += 2)
      if (attributes[0] == name) return plain(attributes[1]);
    return {};
  }

 private:
  struct Free {
    void operator()(XML_Parser parser) const { XML_ParserFree(parser); }
  };

  static std::string_view local_name(std::string_view name) { return name.substr(name.rfind(':') + 1); }
  /// Returns the text on one line, without the blanks around it.
  static std::string plain(std::string_view content) {
    return std::string(trimmed(without_controls(std::string(content))));
  }

  std::string_view text_;
  const std::string& file_;
  std::string_view kind_;
  std::unique_ptr<std::remove_pointer_t<XML_Parser>, Free> parser_;
  std::string content_;
  std::string failure_;
};

}  // namespace kinesphere::program

#endif
