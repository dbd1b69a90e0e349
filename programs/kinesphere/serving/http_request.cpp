// Parses the head of an HTTP request, and decides which requests to refuse.
#include "serving/http_request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/ascii_text.hpp"

namespace kinesphere::program {
namespace {

constexpr std::string_view line_end = "\r\n";

/// Returns the text up to `separator` and takes it and the separator off `rest`; nothing if there is no
/// separator.
std::optional<std::string_view> take_until(std::string_view& rest, std::string_view separator) {
  const std::size_t at = rest.find(separator);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view taken = rest.substr(0, at);
  rest.remove_prefix(at + separator.size());
  return taken;
}

bool is_token(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return (lower_case(c) >= 'a' && lower_case(c) <= 'z') || (c >= '0' && c <= '9') ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
}

std::optional<int> hexadecimal(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (lower_case(c) >= 'a' && lower_case(c) <= 'f') return lower_case(c) - 'a' + 10;
  return std::nullopt;
}

/// Returns the decoded path of a request target; nothing if it is no path or encodes a control character.
std::optional<std::string> path_of(std::string_view target) {
  if (!target.starts_with('/')) return std::nullopt;
  target = target.substr(0, target.find_first_of("?#"));
  std::string path;
  for (std::size_t k = 0; k < target.size(); ++k) {
    char c = target[k];
    if (c == '%') {
      if (target.size() - k < 3) return std::nullopt;
      const auto high = hexadecimal(target[k + 1]), low = hexadecimal(target[k + 2]);
      if (!high || !low) return std::nullopt;
      c = static_cast<char>(*high * 16 + *low);
      k += 2;
    }
    if (is_control(c)) return std::nullopt;
    path += c;
  }
  return path;
}

struct RequestLine {
  std::string_view method, target;
};

std::optional<RequestLine> parse_request_line(std::string_view line) {
  const auto method = take_until(line, " ");
  const auto target = take_until(line, " ");
  if (!method || !target || !is_token(*method)) return std::nullopt;
  if (line != "HTTP/1.1" && line != "HTTP/1.0") return std::nullopt;
  return RequestLine{.method = *method, .target = *target};
}

/// The fields with an effect. A repeated field has its last value.
struct Fields {
  int hosts = 0;  ///< number of Host fields
  std::string_view host, fetch_site, fetch_mode;
};

/// Parses the lines of the fields, up to the empty line.
std::optional<Fields> parse_fields(std::string_view lines) {
  Fields fields;
  while (auto line = take_until(lines, line_end)) {
    if (line->empty()) return fields;
    const auto name = take_until(*line, ":");
    if (!name || !is_token(*name)) return std::nullopt;
    if (std::ranges::any_of(*line, [](char c) { return is_control(c) && c != '\t'; })) return std::nullopt;
    const std::string_view value = trimmed(*line);
    if (same_name(*name, "Host")) {
      ++fields.hosts;
      fields.host = value;
    } else if (same_name(*name, "Sec-Fetch-Site")) {
      fields.fetch_site = value;
    } else if (same_name(*name, "Sec-Fetch-Mode")) {
      fields.fetch_mode = value;
    }
  }
  return std::nullopt;
}

/// Returns true if the request comes from a page of another site, which may use a host name of its own that
/// resolves to this machine (DNS rebinding), or embed a page of this server. A link to this server is
/// allowed.
bool is_from_elsewhere(const Fields& fields, int port) {
  if (fields.hosts != 1) return true;
  if (fields.host != fmt::format("127.0.0.1:{}", port) && fields.host != fmt::format("localhost:{}", port))
    return true;
  return fields.fetch_site == "cross-site" && fields.fetch_mode != "navigate";
}

}  // namespace

std::variant<HttpRequest, HttpStatus> parse_http_request(std::string_view head, int port) {
  const auto first = take_until(head, line_end);
  const auto line = first ? parse_request_line(*first) : std::nullopt;
  const auto fields = line ? parse_fields(head) : std::nullopt;
  if (!fields) return HttpStatus::bad_request;
  const bool is_get = line->method == "GET", is_head = line->method == "HEAD";
  auto path = path_of(line->target);
  if (!path && (is_get || is_head)) return HttpStatus::bad_request;
  if (is_from_elsewhere(*fields, port)) return HttpStatus::forbidden;
  if (!path || !(is_get || is_head)) return HttpStatus::method_not_allowed;
  return HttpRequest{.is_head = is_head, .path = std::move(*path)};
}

}  // namespace kinesphere::program
