// Parses the head of an HTTP request, and decides which requests to refuse.
#pragma once

#include <string>
#include <string_view>
#include <variant>

namespace kinesphere::program {

enum class HttpStatus : int {
  ok = 200,
  bad_request = 400,
  forbidden = 403,
  not_found = 404,
  method_not_allowed = 405,
  head_too_large = 431,
  internal_error = 500,
};

struct HttpRequest {
  bool is_head = false;  ///< HEAD, which gets no body; otherwise GET
  std::string path;      ///< percent-decoded, begins with '/', without the query
};

/// Parses the head of a request, from its method to its empty line, by the grammar of RFC 9112 without its
/// leniencies. Fields other than Host and Sec-Fetch-* have no effect, so ranges, bodies, codings and upgrades
/// do not exist here. Returns, in this order: bad_request if it is no HTTP/1 request for a path; forbidden
/// unless its one Host is "127.0.0.1:port" or "localhost:port", or if a page of another site asks for it
/// other than by a link; method_not_allowed unless it is GET or HEAD.
std::variant<HttpRequest, HttpStatus> parse_http_request(std::string_view head, int port);

}  // namespace kinesphere::program
