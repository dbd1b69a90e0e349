// Addresses of subjects: nats://HOST:PORT/SUBJECT.
#pragma once

#include <string>
#include <string_view>

namespace kinesphere::program {

struct NatsAddress {
  std::string server;  ///< with a user and password, if there are any: not to be shown
  std::string subject;
  std::string name;  ///< name for messages
};

bool is_nats_address(std::string_view text);
/// Throws ProgramError naming the option or argument.
NatsAddress parse_nats_address(std::string_view text, std::string_view option);

}  // namespace kinesphere::program
