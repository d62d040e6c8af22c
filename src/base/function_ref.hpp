// SPDX-License-Identifier: BSD-3-Clause
// A reference to a callable with a given signature, like std::function_ref of C++26. It consists of
// two pointers and allocates nothing. A function that takes one is compiled once instead of once
// per callable.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace pnpbs {

template <class Signature>
class FunctionRef;

// The callable must outlive the reference.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Callable>
  requires(!std::is_same_v<std::remove_cvref_t<Callable>, FunctionRef>)
      FunctionRef(Callable&& callable)  // NOLINT: converts implicitly, as std::function_ref does
      : callable_(const_cast<void*>(static_cast<const void*>(std::addressof(callable)))),
        call_([](void* object, Arguments... arguments) -> Result {
          return (*static_cast<std::remove_reference_t<Callable>*>(object))(
              std::forward<Arguments>(arguments)...);
        }) {}

  Result operator()(Arguments... arguments) const {
    return call_(callable_, std::forward<Arguments>(arguments)...);
  }

 private:
  void* callable_;
  Result (*call_)(void*, Arguments...);
};

}  // namespace pnpbs
