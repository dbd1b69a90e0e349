// A connection to a NATS server that is made again whenever it breaks.
#pragma once

#include <nats/nats.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "watch/nats/nats_address.hpp"

namespace kinesphere::program {

template <auto destroy>
struct NatsDelete {
  template <class Value>
  void operator()(Value* value) const {
    destroy(value);
  }
};

using NatsMessage = std::unique_ptr<natsMsg, NatsDelete<natsMsg_Destroy>>;
using NatsSubscription = std::unique_ptr<natsSubscription, NatsDelete<natsSubscription_Destroy>>;
using NatsStreamInfo = std::unique_ptr<jsStreamInfo, NatsDelete<jsStreamInfo_Destroy>>;

/// Whether all that has a subject, which may have wildcards, has one that these hold.
bool holds_all_of(const std::vector<std::string>& held, std::string_view subject);

/// Functions throw ProgramError naming the address.
class NatsConnection {
 public:
  explicit NatsConnection(const NatsAddress& address, bool is_quiet = false);

  natsConnection* get() const { return connection_.get(); }
  jsCtx* jetstream() const { return jetstream_.get(); }
  const NatsAddress& address() const { return address_; }
  bool is_connected() const { return natsConnection_Status(connection_.get()) == NATS_CONN_STATUS_CONNECTED; }

  /// The stream of JetStream that holds a subject; nothing where there is none, or no JetStream. One that
  /// holds some of the subjects that are meant by a wildcard is refused.
  std::optional<std::string> stream_of(const std::string& subject) const;
  /// `status` is NATS_NOT_FOUND where there is no such stream, and another one while the server does not
  /// answer.
  NatsStreamInfo stream_info(const std::string& stream, natsStatus& status) const;

  /// On standard error, unless the program is to be quiet.
  void warn(const std::string& what) const;
  /// Fails where the server has refused the connection for good: otherwise it is made again.
  void check_open() const;
  [[noreturn]] void fail(natsStatus status, const char* what) const;

 private:
  NatsAddress address_;
  bool is_quiet_;
  std::unique_ptr<natsConnection, NatsDelete<natsConnection_Destroy>> connection_;
  std::unique_ptr<jsCtx, NatsDelete<jsCtx_Destroy>> jetstream_;
};

}  // namespace kinesphere::program
