#include "base/error.h"

#include <exception>
#include <new>

namespace unshot {

Error presentError() {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ErrorKind::kEnvironment, "there is not enough memory", {},
                 "fewer elements, less memory for form factors (--keep) or a smaller picture");
  } catch (const std::exception& error) {
    return Error(ErrorKind::kInternal, error.what());
  } catch (...) {
    return Error(ErrorKind::kInternal, "an unknown exception");
  }
}

}  // namespace unshot
