/// States that a run keeps: to be undone to, and for others to go on from.

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "simulation_state.h"

namespace geocontainer_mpm::scene {

template <int Dim>
void Run<Dim>::save()
{
  if (checkpoint_) {
    checkpoint_->model = model.state();
    checkpoint_->progress = progress;
    checkpoint_->watch = watch;
    checkpoint_->probes = probes;
    checkpoint_->energy = model.energy();
  } else {
    checkpoint_.emplace(Checkpoint{ model.state(), progress, watch, probes, model.energy() });
  }
  steps_since_checkpoint_ = 0;
}

/// Back to the last checkpoint, with steps of half the length until the doubtful time has passed; or the end.
template <int Dim>
Advance Run<Dim>::undo(const Failure& failure)
{
  const double wrong_s = progress.time_s;
  const std::uint64_t retries = progress.retries;
  const int halvings = progress.halvings;
  model.restore(checkpoint_->model);
  progress = checkpoint_->progress;
  watch = checkpoint_->watch;
  probes = checkpoint_->probes;
  steps_since_checkpoint_ = 0;
  progress.retries = retries;
  if (halvings < scene.numerics.max_halvings) {
    ++progress.retries;
    progress.halvings = halvings + 1;
    progress.doubtful_s = std::max(progress.doubtful_s, wrong_s);
    checkpoint_->progress = progress;
    return Advance::stepped;
  }
  progress.stopped = true;
  progress.failure = failure;
  progress.failure.time_s = wrong_s;
  if (scene.numerics.max_halvings > 0)
    progress.failure.reason +=
        fmt::format("; steps of 1/{} of the stable length did not help", 1 << scene.numerics.max_halvings);
  return Advance::stopped;
}

template <int Dim>
std::optional<typename Run<Dim>::Checkpoint> Run<Dim>::right_state() const
{
  if (progress.resting && checkpoint_)
    return Checkpoint{ model.state(), progress, watch, probes, model.energy() };
  return checkpoint_;
}

template <int Dim>
void Run<Dim>::go_on(Checkpoint state)
{
  model.restore(state.model);
  progress = state.progress;
  watch = state.watch;
  probes = state.probes;
  checkpoint_ = std::move(state);
  steps_since_checkpoint_ = 0;
}

template <int Dim>
std::optional<Kept<Dim>> Run<Dim>::keep() const
{
  std::optional<Checkpoint> now = right_state();
  if (!now)
    return std::nullopt;
  return Kept<Dim>{ std::move(*now), opening, settled, fresh_probes, fresh_progress, explained_speed_ };
}

template <int Dim>
void Run<Dim>::go_on_from(const Kept<Dim>& kept)
{
  opening = kept.opening;
  settled = kept.settled;
  fresh_probes = kept.fresh_probes;
  fresh_progress = kept.fresh_progress;
  explained_speed_ = kept.explained_speed;
  go_on(kept.now);
}

template void Run<2>::save();
template Advance Run<2>::undo(const Failure&);
template std::optional<Run<2>::Checkpoint> Run<2>::right_state() const;
template void Run<2>::go_on(Checkpoint);
template std::optional<Kept<2>> Run<2>::keep() const;
template void Run<2>::go_on_from(const Kept<2>&);
template void Run<3>::save();
template Advance Run<3>::undo(const Failure&);
template std::optional<Run<3>::Checkpoint> Run<3>::right_state() const;
template void Run<3>::go_on(Checkpoint);
template std::optional<Kept<3>> Run<3>::keep() const;
template void Run<3>::go_on_from(const Kept<3>&);

}  // namespace geocontainer_mpm::scene
