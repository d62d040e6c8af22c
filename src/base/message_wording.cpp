// SPDX-License-Identifier: BSD-3-Clause
#include "base/message_text.hpp"

namespace pnpbs {

MessageText as_worded(MessageText message) { return message; }

}  // namespace pnpbs
