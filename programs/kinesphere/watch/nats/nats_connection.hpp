// A connection to a NATS server that is made again whenever it breaks.
#pragma once

#include <nats/nats.h>

#include <memory>
#include <optional>
#include <string>

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

/// Functions throw ProgramError naming the address.
class NatsConnection {
 public:
  explicit NatsConnection(const NatsAddress& address);

  natsConnection* get() const { return connection_.get(); }
  jsCtx* jetstream() const { return jetstream_.get(); }
  const NatsAddress& address() const { return address_; }
  bool is_connected() const { return natsConnection_Status(connection_.get()) == NATS_CONN_STATUS_CONNECTED; }

  /// The stream of JetStream that holds a subject; nothing where there is none, or no JetStream.
  std::optional<std::string> stream_of(const std::string& subject) const;
  /// Nothing while the server does not answer.
  NatsStreamInfo stream_info(const std::string& stream) const;

  [[noreturn]] void fail(natsStatus status, const char* what) const;

 private:
  NatsAddress address_;
  std::unique_ptr<natsConnection, NatsDelete<natsConnection_Destroy>> connection_;
  std::unique_ptr<jsCtx, NatsDelete<jsCtx_Destroy>> jetstream_;
};

}  // namespace kinesphere::program
