#include "base/error.h"

#include <exception>
#include <new>
#include <system_error>

namespace unshot {

Error presentError() {
  try {
    throw;
  } catch (const Error& error) {
    return error;
  } catch (const std::bad_alloc&) {
    return Error(ErrorKind::kEnvironment, "there is not enough memory", {},
                 "fewer elements, less memory for form factors (--keep) or a smaller picture");
  } catch (const std::system_error& error) {  // a thread that cannot be started, say
    return Error(ErrorKind::kEnvironment, std::string("the system refuses: ") + error.what(), {},
                 "more memory, processes or files for it (ulimit -a lists the limits)");
  } catch (const std::exception& error) {
    return Error(ErrorKind::kInternal, std::string("internal error: ") + error.what(), {},
                 "please report it with the command and the scene");
  } catch (...) {
    return Error(ErrorKind::kInternal, "internal error: an unknown exception");
  }
}

}  // namespace unshot
