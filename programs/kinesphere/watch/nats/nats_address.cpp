// Addresses of subjects: nats://HOST:PORT/SUBJECT.
#include "watch/nats/nats_address.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/program_error.hpp"

namespace kinesphere::program {

bool is_nats_address(std::string_view text) {
  return text.starts_with("nats://") || text.starts_with("tls://");
}

NatsAddress parse_nats_address(std::string_view text, std::string_view option) {
  const std::size_t begin = text.find("//") + 2;
  const std::size_t slash = std::min(text.find('/', begin), text.size());
  const std::string_view host = text.substr(begin, slash - begin);
  const std::string_view subject = text.substr(std::min(slash + 1, text.size()));
  const std::size_t at = host.rfind('@');
  const std::string_view shown_host = at == std::string_view::npos ? host : host.substr(at + 1);
  const std::string name = fmt::format("{}{}/{}", text.substr(0, begin), shown_host, subject);
  const bool has_gap = subject.starts_with('.') || subject.ends_with('.') ||
                       subject.find("..") != std::string_view::npos ||
                       subject.find_first_of(" \t\r\n/") != std::string_view::npos;
  if (shown_host.empty() || subject.empty() || has_gap)
    throw ProgramError(fmt::format(
        "{}: expected a server and a subject, nats://HOST:PORT/SUBJECT, but got '{}'", option, name));
  return {std::string(text.substr(0, slash)), std::string(subject), name};
}

}  // namespace kinesphere::program
