#include "driver/checkpoints.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <csignal>

#include "base/progress.h"
#include "io/checkpoint.h"
#include "koshi/input.h"
#include "model/pre_cracks.h"

namespace koshi::driver {
namespace {

volatile std::sig_atomic_t stop_signal = 0;

// Asks for a stop after a checkpoint; who presses Ctrl-C twice does not want to wait for it.
void request_stop(int signal) {
  if (stop_signal == SIGINT && signal == SIGINT) {
    std::signal(SIGINT, SIG_DFL);
    std::raise(SIGINT);
  }
  stop_signal = signal;
}

// From people and shells; from batch systems before the time is up; from launchers, which pass SIGUSR1 and SIGUSR2 on
// to their ranks; from a terminal that is closed.
constexpr std::array stop_signals{SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, SIGHUP};

// Name of the step's length among the numbers of a checkpoint.
constexpr const char* time_step_name = "time_step";
// 1 among them: the checkpoint has the fields of cracks; of broken bonds.
constexpr const char* cracks_name = "cracks";
constexpr const char* bonds_name = "bonds";

// 1 among them: displacements of a periodic body under a mean strain.
constexpr const char* mean_strain_name = "mean_strain";

// Largest reaction that analysis.stop_when has seen.
constexpr const char* peak_force_name = "peak_force";

// What must be equal for a run to go on: everything but the output, how long to run and what ends it before.
std::string case_text(model::Definition definition) {
  definition.title.clear();
  definition.output = {};
  definition.analysis.stop_when.reset();
  if (definition.analysis.type == model::AnalysisDefinition::Type::dynamic) definition.analysis.duration = 1;
  if (definition.analysis.type == model::AnalysisDefinition::Type::quasi_static) definition.analysis.duration.reset();
  return io::resolved_toml(definition);
}

std::vector<io::CheckpointField> extra_fields(model::State& state) {
  std::vector<io::CheckpointField> fields;
  if (state.orientation.components() != 0) fields.push_back({"orientation", &state.orientation});
  if (state.crack.components() != 0) {
    fields.push_back({"crack", &state.crack});
    fields.push_back({"work", &state.work});
  }
  if (state.bonds.components() != 0) fields.push_back({"bonds", &state.bonds});
  return fields;
}

}  // namespace

Checkpoints::Checkpoints(const model::Model& model, std::filesystem::path directory)
    : model_(model),
      directory_(std::move(directory)),
      case_text_(case_text(model.definition)),
      last_wall_(steady_seconds()) {
  stop_signal = 0;
  // A signal that was ignored before, as nohup does with SIGHUP, stays so.
  for (const int signal : stop_signals)
    if (const auto before = std::signal(signal, request_stop); before != SIG_ERR) before_.emplace_back(signal, before);
  for (const auto& [signal, before] : before_)
    if (before == SIG_IGN) std::signal(signal, SIG_IGN);
}

Checkpoints::~Checkpoints() {
  for (const auto& [signal, before] : before_) std::signal(signal, before);
}

void Checkpoints::restore(const std::filesystem::path& file, model::State& state) {
  const auto fields = extra_fields(state);
  const io::CheckpointInfo info = io::read_checkpoint(file, model_, case_text_, state, fields);
  const model::AnalysisDefinition& analysis = model_.definition.analysis;
  if (analysis.type == model::AnalysisDefinition::Type::statics)
    throw InputError(fmt::format(
        "nothing is left to do: {} holds the equilibrium of this case; without --restart it is computed anew",
        file.native()));
  if (analysis.duration && *analysis.duration < (1 - 1e-9) * info.time)
    throw InputError(
        model_.definition.places.find("analysis.duration"),
        fmt::format("{} is of t = {:.6g} s, after the end of a run of {:.6g} s; give a duration of more than {:.6g} s",
                    file.native(), info.time, *analysis.duration, info.time));
  state.time = info.time;
  state.step = info.step;
  // The step of the run so far, so that another duration changes nothing but the end.
  const auto step = info.scalars.find(time_step_name);
  if (step != info.scalars.end()) {
    if (!(step->second > 0) || std::isinf(step->second))
      throw InputError(fmt::format("checkpoint {} has a time step of {} s", file.native(), step->second));
    state.time_step = step->second;
  }
  if (const auto peak = info.scalars.find(peak_force_name); peak != info.scalars.end()) state.peak_force = peak->second;
  last_ = file;
}

bool Checkpoints::stop_requested() const { return model_.communicator.any(stop_signal != 0); }

bool Checkpoints::poll(model::State& state) {
  const model::OutputDefinition& output = model_.definition.output;
  const double wall = steady_seconds();
  const bool stop = stop_requested();
  const bool by_time = output.checkpoint_every && state.time >= last_time_ + *output.checkpoint_every;
  // Clocks differ between ranks: the root's decides.
  const bool by_wall = output.checkpoint_wall && model_.communicator.any(model_.communicator.is_root() &&
                                                                         wall >= last_wall_ + *output.checkpoint_wall);
  if (stop || by_time || by_wall) write(state);
  return stop;
}

std::string Checkpoints::remedy() const {
  std::error_code ignored;
  if (last_.empty() || !std::filesystem::exists(last_, ignored)) return "";
  return "; the last checkpoint is whole: --restart " + last_.string();
}

void Checkpoints::write(model::State& state) {
  write_to(directory_, state);
  last_ = directory_ / "checkpoint.h5";
  last_time_ = state.time;
  last_wall_ = steady_seconds();
}

std::filesystem::path Checkpoints::write_diverged(model::State& state) {
  const std::filesystem::path directory = directory_ / "diverged";
  if (model_.communicator.is_root()) std::filesystem::create_directories(directory);
  model_.communicator.barrier();
  write_to(directory, state);
  return directory / "checkpoint.h5";
}

void Checkpoints::write_to(const std::filesystem::path& directory, model::State& state) const {
  io::CheckpointInfo info;
  info.case_text = case_text_;
  if (state.time_step > 0) info.scalars[time_step_name] = state.time_step;
  if (state.crack.components() != 0) info.scalars[cracks_name] = 1;
  if (state.bonds.components() != 0) info.scalars[bonds_name] = 1;
  if (state.peak_force > 0) info.scalars[peak_force_name] = state.peak_force;
  if (state.mean_strain != std::array<double, 6>{}) info.scalars[mean_strain_name] = 1;
  const auto fields = extra_fields(state);
  io::write_checkpoint(directory, model_, state, info, fields);
}

void start_from(const std::filesystem::path& directory, const model::Model& model, model::State& state) {
  // Its own text is accepted: the case may differ, the lattice is still compared.
  const io::CheckpointInfo header = io::read_checkpoint_header(directory, model.communicator);
  if (header.scalars.contains(mean_strain_name))
    throw InputError(model.definition.places.find("analysis.start_from"),
                     fmt::format("{} holds a periodic body under a macroscopic strain, which no run can go on from; "
                                 "start from a body that a load strained",
                                 directory.native()));
  // Cracks stay; a body at rest so far, or an equilibrium, has none.
  const bool cracked = header.scalars.contains(cracks_name);
  if (cracked && state.crack.components() == 0)
    throw InputError(model.definition.places.find("analysis.start_from"),
                     fmt::format("{} holds a body that can crack, and no material of this case can; give them the "
                                 "fracture they had",
                                 directory.native()));
  const bool by_bonds = state.bonds.components() != 0;
  if (cracked && by_bonds != header.scalars.contains(bonds_name))
    throw InputError(model.definition.places.find("analysis.start_from"),
                     fmt::format("{} holds a body whose {}; the fracture of this case must have the same law",
                                 directory.native(), by_bonds ? "cells crack" : "bonds break"));
  std::vector<io::CheckpointField> cracks;
  if (cracked) cracks.push_back({"crack", &state.crack});
  if (cracked && by_bonds) cracks.push_back({"bonds", &state.bonds});
  io::read_checkpoint(directory, model, header.case_text, state, cracks);
  // Cracks of this case come to those that are there; when those opened was another run's time.
  if (state.crack.components() != 0) {
    if (by_bonds)
      model::break_bonds(model, state.bonds);
    else
      model::add_cracks(model, state.crack);
    std::fill_n(state.crack.component(model::crack_moment), state.crack.stride(), 0.0);
  }
  state.peak_force = 0;
  state.velocity.zero();
  state.time = 0;
  state.step = 0;
  state.time_step = 0;
}

}  // namespace koshi::driver
