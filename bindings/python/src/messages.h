// Messages of a world as Python keeps them, and the function of Python that gets them.
#pragma once

#include <pybind11/pybind11.h>
#include <tact/message.h>

namespace tact::python {

void define_messages(pybind11::module_& module);

/// Settings::on_message for a function of Python, or none for None. @throws TypeError if it cannot be called.
MessageFunction message_function(const pybind11::object& function);
/// The function of Python that `told` calls, or None.
pybind11::object python_function(const MessageFunction& told);

}  // namespace tact::python
