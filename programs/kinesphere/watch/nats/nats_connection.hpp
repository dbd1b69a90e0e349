// A connection to a NATS server that reconnects whenever it breaks.
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

/// Returns true if the held subjects cover all subjects that match `subject`, which may have wildcards.
bool holds_all_of(const std::vector<std::string>& held, std::string_view subject);

/// Functions throw ProgramError naming the address.
class NatsConnection {
 public:
  explicit NatsConnection(const NatsAddress& address, bool is_quiet = false);

  natsConnection* get() const { return connection_.get(); }
  jsCtx* jetstream() const { return jetstream_.get(); }
  const NatsAddress& address() const { return address_; }
  bool is_connected() const { return natsConnection_Status(connection_.get()) == NATS_CONN_STATUS_CONNECTED; }

  /// Returns the JetStream stream that holds a subject; nothing if there is none, or no JetStream. Throws
  /// ProgramError if a stream holds only some of the subjects of a wildcard.
  std::optional<std::string> stream_of(const std::string& subject) const;
  /// `status` is NATS_NOT_FOUND if there is no such stream, and another value while the server does not
  /// answer.
  NatsStreamInfo stream_info(const std::string& stream, natsStatus& status) const;

  /// Writes to standard error, unless the program is quiet.
  void warn(const std::string& what) const;
  /// Throws if the server has refused the connection for good; other failures reconnect.
  void check_open() const;
  [[noreturn]] void fail(natsStatus status, const char* what) const;

 private:
  NatsAddress address_;
  bool is_quiet_;
  std::unique_ptr<natsConnection, NatsDelete<natsConnection_Destroy>> connection_;
  std::unique_ptr<jsCtx, NatsDelete<jsCtx_Destroy>> jetstream_;
};

}  // namespace kinesphere::program
