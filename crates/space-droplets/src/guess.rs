//! A guess for the velocities of a state, from the velocities of earlier states.

use motile_base::internal::dot;

/// Earlier states that are kept: extrapolation by a polynomial of one degree less.
const KEPT: usize = 5;
/// Part of a state below which its difference from others is round-off.
const NEW: f64 = 1e-9;

/// Earlier states with their velocities.
///
/// Along a run, velocities are a smooth function of the state, and the states are on a smooth curve. So the point next
/// to the present state in the plane through the earlier states is a good guess for the state, and the same combination
/// of velocities for its velocities. The order of the states in time does not matter, as among stages of a step.
#[derive(Debug, Clone, Default)]
pub(crate) struct Guess {
    present: Vec<f64>,
    /// What the differences leave of the present state.
    rest: Vec<f64>,
    /// States without dimension and their velocities, the newest first.
    kept: Vec<[Vec<f64>; 2]>,
    used: usize,
    /// Orthogonal differences of states from the newest one, and the same combinations of velocities.
    differences: Vec<[Vec<f64>; 2]>,
}

impl Guess {
    /// Forgets all states.
    pub(crate) fn forget(&mut self) {
        self.used = 0;
    }

    /// Takes over the present state, without dimension, and writes a guess for its velocities: zero if there are no
    /// earlier states.
    pub(crate) fn write(&mut self, state: impl Iterator<Item = f64>, out: &mut [f64]) {
        let Self { present, rest, kept, used, differences } = self;
        present.clear();
        present.extend(state);
        let fits = |pair: &[Vec<f64>; 2]| pair[0].len() == present.len() && pair[1].len() == out.len();
        let Some(([state, velocities], others)) =
            kept[..*used].split_first().filter(|_| kept[..*used].iter().all(fits))
        else {
            *used = 0;
            out.fill(0.0);
            return;
        };
        out.copy_from_slice(velocities);
        let least = NEW * dot(state, state).sqrt();
        rest.clone_from(present);
        subtract(rest, 1.0, state);
        let mut count = 0;
        for pair in others {
            let (done, free) = differences.split_at_mut(count);
            let Some(next) = free.first_mut() else { break };
            for (next, (list, newest)) in next.iter_mut().zip(pair.iter().zip([state, velocities])) {
                next.clone_from(list);
                subtract(next, 1.0, newest);
            }
            for before in done {
                let part = dot(&next[0], &before[0]) / dot(&before[0], &before[0]);
                for (next, before) in next.iter_mut().zip(before) {
                    subtract(next, part, before);
                }
            }
            let square = dot(&next[0], &next[0]);
            if square.sqrt() > least {
                let part = dot(rest, &next[0]) / square;
                subtract(rest, part, &next[0]);
                subtract(out, -part, &next[1]);
                count += 1;
            }
        }
    }

    /// Keeps the velocities of the present state.
    pub(crate) fn keep(&mut self, velocities: &[f64]) {
        // All memory at once, so that later steps need none.
        for list in [&mut self.kept, &mut self.differences] {
            list.resize_with(KEPT, || [self.present.clone(), velocities.to_vec()]);
        }
        self.kept.rotate_right(1);
        self.kept[0][0].clone_from(&self.present);
        self.kept[0][1].clear();
        self.kept[0][1].extend_from_slice(velocities);
        self.used = (self.used + 1).min(KEPT);
    }

    /// Returns the number of states that are kept.
    pub(crate) fn len(&self) -> usize {
        self.used
    }

    /// Returns all states with their velocities for a checkpoint, one after the other.
    pub(crate) fn save(&self) -> impl Iterator<Item = f64> {
        self.kept[..self.used].iter().flatten().flatten().copied()
    }

    /// Takes over what [`Guess::save`] returned, for states and velocities of these lengths.
    pub(crate) fn load(&mut self, [state, velocities]: [usize; 2], saved: &[f64]) {
        for list in [&mut self.kept, &mut self.differences] {
            list.clear();
            list.resize(KEPT, [vec![0.0; state], vec![0.0; velocities]]);
        }
        self.used = 0;
        for (pair, list) in self.kept.iter_mut().zip(saved.chunks_exact((state + velocities).max(1))) {
            *pair = [list[..state].to_vec(), list[state..].to_vec()];
            self.used += 1;
        }
    }
}

/// Subtracts a multiple of a list.
fn subtract(from: &mut [f64], factor: f64, list: &[f64]) {
    from.iter_mut().zip(list).for_each(|(value, entry)| *value -= factor * entry);
}

#[cfg(test)]
mod tests;
