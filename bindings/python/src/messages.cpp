#include "messages.h"

#include <memory>
#include <string>
#include <utility>

#include "interpreter.h"
#include "text.h"

namespace tact::python {

namespace {

// A message with a text of its own: Python may keep it.
struct KeptMessage {
  MessageKind kind;
  BodyId a, b;
  std::string text;
};

// The interpreter's lock, for threads of the engine.
class Lock {
 public:
  Lock() : state_(waiting_at_exit([] { return PyGILState_Ensure(); })) {}
  ~Lock() { PyGILState_Release(state_); }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;

 private:
  PyGILState_STATE state_;
};

// Copied and forgotten without the lock: only the last copy takes it.
class PythonFunction {
 public:
  explicit PythonFunction(py::object function) : function_(std::make_shared<Held>(std::move(function))) {}
  void operator()(const Message& message) const {
    const Lock lock;
    call_python(function_->function, KeptMessage{message.kind, message.a, message.b, std::string(message.text)});
  }
  const py::object& function() const { return function_->function; }

 private:
  struct Held {
    explicit Held(py::object given) : function(std::move(given)) {}
    ~Held() {
      const Lock lock;
      function = py::object();
    }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    py::object function;
  };
  std::shared_ptr<const Held> function_;
};

}  // namespace

MessageFunction message_function(const py::object& function) {
  if (function.is_none()) return {};
  if (PyCallable_Check(function.ptr()) == 0)
    throw py::type_error("on_message is a " + std::string(py::str(py::type::of(function).attr("__name__"))) +
                         ", not a function or None");
  return PythonFunction(function);
}

py::object python_function(const MessageFunction& told) {
  const auto* function = told.target<PythonFunction>();
  return function == nullptr ? py::object(py::none()) : function->function();
}

void define_messages(py::module_& module) {
  py::enum_<MessageKind>(module, "MessageKind", "What a message is about.")
      .value("direction_limit", MessageKind::direction_limit,
             "the search for the direction of a contact stopped at a limit")
      .value("gjk_limit", MessageKind::gjk_limit, "GJK stopped at its limit for pairs that are taken to be apart")
      .value("point_limit", MessageKind::point_limit, "a body crosses itself deeper than its points are found")
      .value("open_surface", MessageKind::open_surface, "a body was added as closed, and is taken as a sheet")
      .value("inside_out", MessageKind::inside_out,
             "a closed body was added whose facets are clockwise seen from outside");
  py::class_<KeptMessage>(module, "Message",
                          "A limit that a step reached, or what is wrong with a body that was added.")
      .def_readonly("kind", &KeptMessage::kind)
      .def_readonly("a", &KeptMessage::a, "the first body of the pair, or no body")
      .def_readonly("b", &KeptMessage::b)
      .def_property_readonly(
          "text", [](const KeptMessage& message) { return sentence(message.text); }, "one sentence")
      .def("__repr__", [](const KeptMessage& message) { return sentence("<tact.Message: " + message.text + ">"); });
}

}  // namespace tact::python
