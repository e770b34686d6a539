#include "simulation.h"

#include <pybind11/functional.h>
#include <pybind11/stl.h>

#include "driver/fields.h"
#include "driver/run_simulation.h"
#include "driver/simulation.h"
#include "fields.h"
#include "koshi/run.h"

namespace koshi::python {

namespace py = pybind11;
using driver::Simulation;

namespace {

Communicator communicator(const std::optional<int>& handle) {
  return handle ? Communicator::from_handle(*handle) : Communicator::world();
}

py::dict measured(const model::Model& model, const mechanics::Measurement& measurement) {
  py::dict probes;
  for (std::size_t p = 0; p < measurement.probes.size(); ++p)
    probes[py::str(model.probes[p].definition.name)] =
        py::array_t<double>(static_cast<py::ssize_t>(measurement.probes[p].size()), measurement.probes[p].data());
  const mechanics::Balance& balance = measurement.balance;
  return py::dict(py::arg("elastic_energy") = balance.elastic_energy,
                  py::arg("kinetic_energy") = balance.kinetic_energy,
                  py::arg("unbalanced_ratio") = balance.unbalanced_ratio(), py::arg("probes") = probes);
}

// An interrupt (Ctrl-C) waits for the interpreter until its lock is taken.
void raise_interrupt() {
  const py::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

py::object macroscopic_of(const driver::Outcome& outcome) {
  if (!outcome.measurement.mean) return py::none();
  const mechanics::MeanState& whole = *outcome.measurement.mean;
  return py::dict(py::arg("strain") = py::array_t<double>(6, whole.strain.data()),
                  py::arg("stress") = py::array_t<double>(6, whole.stress.data()));
}

py::list modes_of(const model::Model& model, const driver::Outcome& outcome) {
  py::list list;
  if (!outcome.modes) return list;
  const Int3& n = model.layout().owned();
  for (const modes::Mode& mode : outcome.modes->modes)
    list.append(py::dict(py::arg("number") = mode.number, py::arg("frequency") = mode.frequency,
                         py::arg("residual") = mode.residual, py::arg("modal_mass") = mode.modal_mass,
                         py::arg("participation") = py::array_t<double>(6, mode.participation.data()),
                         py::arg("effective_mass") = py::array_t<double>(6, mode.effective_mass.data()),
                         py::arg("shape") = py::array_t<double>(
                             std::vector<py::ssize_t>{model.components(), n[2], n[1], n[0]}, mode.shape.data())));
  return list;
}

// Runs to the end of the analysis, with files where a directory is given.
driver::Outcome run(Simulation& simulation, const driver::Observer& observer,
                    const std::optional<std::string>& directory, const std::vector<std::string>& petsc_options) {
  if (!directory) return simulation.run(observer, petsc_options);
  driver::RunOptions options;
  options.directory = *directory;
  options.quiet = true;
  options.petsc_options = petsc_options;
  return driver::run_simulation(simulation, options, observer);
}

py::dict run_to_end(Simulation& simulation, const std::optional<std::function<bool()>>& poll,
                    const std::optional<std::string>& directory,
                    const std::optional<std::function<void(double, const std::string&)>>& progress,
                    const std::vector<std::string>& petsc_options) {
  driver::Observer observer;
  observer.breathe = raise_interrupt;
  if (poll) observer.poll = [&](model::State&) { return (*poll)(); };
  if (progress) observer.progress = *progress;
  // Other threads of the interpreter go on; the callbacks take its lock for themselves.
  driver::Outcome outcome;
  {
    const py::gil_scoped_release released;
    outcome = run(simulation, observer, directory, petsc_options);
  }
  if (!outcome.stopped) driver::require_rest(simulation.model(), outcome);
  const auto residuals = outcome.solution ? outcome.solution->residual_history : std::vector<double>{};
  if (outcome.solution && !outcome.stopped && poll) (*poll)();
  return py::dict(
      py::arg("steps") = outcome.steps, py::arg("time_step") = outcome.time_step,
      py::arg("iterations") = outcome.solution ? outcome.solution->iterations : 0,
      py::arg("residuals") = py::array_t<double>(static_cast<py::ssize_t>(residuals.size()), residuals.data()),
      py::arg("stopped") = outcome.stopped, py::arg("seconds") = outcome.seconds,
      py::arg("measurement") = measured(simulation.model(), outcome.measurement),
      py::arg("macroscopic") = macroscopic_of(outcome), py::arg("modes") = modes_of(simulation.model(), outcome));
}

py::array field(Simulation& simulation, const std::string& name) {
  const model::Model& model = simulation.model();
  const driver::FieldSet set({name}, model, simulation.state(), simulation.meter());
  if (set.fields().size() != 1)
    throw InputError("there is no field \"" + name + "\" here; take one of output.fields that the case asks for");
  const io::FieldData& data = set.fields().front();
  const Int3 box = data.on_cells ? owned_cells(model.lattice.grid, model.layout()) : model.layout().owned();
  const py::array view =
      view_of(*data.values, model.layout(), data.first_component + data.components, box, py::none(), true);
  return view.attr("__getitem__")(py::slice(data.first_component, data.first_component + data.components, 1))
      .attr("copy")();
}

// Damage of the own cells: what cracks have taken of their springs.
py::array damage(Simulation& simulation) {
  simulation.check_cracks();
  const lattice::Layout& layout = simulation.model().layout();
  const Int3 box = owned_cells(simulation.model().lattice.grid, layout);
  return view_of(simulation.state().crack, layout, 1, box, py::none(), true)[py::int_(0)].attr("copy")();
}

void set_damage(Simulation& simulation, const py::array_t<double, py::array::c_style | py::array::forcecast>& values,
                const Vec3& normal) {
  simulation.check_cracks();
  const lattice::Layout& layout = simulation.model().layout();
  const Int3 box = owned_cells(simulation.model().lattice.grid, layout);
  if (values.ndim() != 3 || values.shape(0) != box[2] || values.shape(1) != box[1] || values.shape(2) != box[0])
    throw InputError("damage: error: the array must have a value for each cell of this rank, [z][y][x], as damage has");
  lattice::Field<double> wanted(layout, 1);
  lattice::for_each(layout, {0, 0, 0}, box,
                    [&](auto i, auto j, auto k, auto n) { wanted.component(0)[n] = values.at(k, j, i); });
  simulation.damage_cells(wanted, normal);
}

}  // namespace

void bind_simulation(py::module_& module) {
  py::class_<Simulation> simulation(module, "Simulation");
  simulation.def(py::init([](const model::Definition& definition, const std::optional<int>& handle) {
    return std::make_unique<Simulation>(definition, communicator(handle));
  }));

  simulation.def("displacement", [](const py::object& self) {
    auto& s = self.cast<Simulation&>();
    const lattice::Layout& layout = s.model().layout();
    return view_of(s.state().displacement, layout, s.model().components(), layout.owned(), self, true);
  });
  simulation.def("velocity", [](const py::object& self) {
    auto& s = self.cast<Simulation&>();
    const lattice::Layout& layout = s.model().layout();
    return view_of(s.state().velocity, layout, s.model().components(), layout.owned(), self, true);
  });
  // The model is frozen: read-only views.
  simulation.def("mass", [](const py::object& self) {
    auto& s = self.cast<Simulation&>();
    auto& inertia = const_cast<lattice::Field<double>&>(s.model().inertia);
    return view_of(inertia, s.model().layout(), inertia.components(), s.model().layout().owned(), self, false);
  });
  simulation.def("cells", [](const py::object& self) {
    auto& s = self.cast<Simulation&>();
    auto& cell = const_cast<lattice::Field<std::uint16_t>&>(s.model().lattice.cell);
    const Int3 box = owned_cells(s.model().lattice.grid, s.model().layout());
    return view_of(cell, s.model().layout(), 1, box, self, false)[py::int_(0)].cast<py::array>();
  });
  simulation.def("coordinates", [](Simulation& s) { return coordinates(s.model().lattice.grid, s.model().layout()); });
  simulation.def("field", field);

  simulation.def("time", [](Simulation& s) { return s.state().time; });
  simulation.def("steps", [](Simulation& s) { return s.state().step; });
  simulation.def("time_step", &Simulation::time_step);
  simulation.def(
      "step", [](Simulation& s, std::int64_t count) { s.step(count, raise_interrupt); },
      py::call_guard<py::gil_scoped_release>());
  simulation.def("run", run_to_end);
  simulation.def("measure", [](Simulation& s) { return measured(s.model(), s.measure()); });
  simulation.def("damage", damage);
  simulation.def("set_damage", set_damage);
  simulation.def("set_load_factor", &Simulation::set_load_factor);
  simulation.def("set_boundary_factor", &Simulation::set_boundary_factor);
}

}  // namespace koshi::python
