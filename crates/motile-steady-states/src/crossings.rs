//! Special points between two points of a branch, where modes cross zero growth.

use crate::branch::{BranchPoint, SpecialKind, SpecialPoint};
use crate::iteration::MOST_ITERATIONS;
use crate::spectrum::NO_GROWTH;
use crate::{Critical, Eigenmode, Parameter, Spectrum, SteadyError, SteadyState, Symmetry};

/// Eigenvalue over D/R^2 that counts as zero: a double one, as of a shift and the velocity that it starts, is off by
/// the square root of the error of the Jacobian, 1e-10.
const NEUTRAL: f64 = 1e-5;
/// Differences of parameter (relative), speed and frequency (in units of D/R and D/R^2) up to which two special points
/// are one, found from both sides.
const SAME: f64 = 1e-4;
/// Halvings of a step before secants: a mode is then nearer to its crossing than to other modes.
const HALVINGS: usize = 6;
/// Distance on either side of a special point, relative to the parameter's scale, at which the mode that crosses there
/// grows and decays: growth rates of D/R^2 times this are far from neutral ones.
const BESIDE: f64 = 3e-4;

/// Returns true for two findings of one special point.
pub(crate) fn is_same(one: &SpecialPoint, other: &SpecialPoint) -> bool {
    let at = |point: &SpecialPoint| {
        let Critical { state, mode } = &point.critical;
        (point.value, state.velocity().length() / state.diffusion_rate(), mode.value.im / state.diffusion_rate())
    };
    let ((a, u, f), (b, v, g)) = (at(one), at(other));
    let oscillates = |point: &SpecialPoint| point.kind == SpecialKind::Hopf;
    oscillates(one) == oscillates(other)
        && one.critical.mode.symmetry == other.critical.mode.symmetry
        && (a - b).abs() < SAME * a.abs()
        && (u - v).abs() < SAME
        && (f - g).abs() < SAME
}

/// Returns the points where modes cross zero growth between two points of a branch.
pub(crate) fn crossings(parameter: Parameter, before: &BranchPoint, after: &BranchPoint) -> Vec<SpecialPoint> {
    let mut found = Vec::new();
    let rate = before.state.diffusion_rate();
    let width = (after.value - before.value).abs();
    for symmetry in [Symmetry::Symmetric, Symmetry::Antisymmetric, Symmetry::None] {
        // Modes that are neutral at both ends, such as the shift of a droplet at rest across a channel, cross nothing.
        let neutral = [before, after].map(|point| neutral_modes(&point.spectrum, symmetry, rate));
        let neutral = neutral[0].min(neutral[1]);
        let [a, b] = [before, after].map(|point| modes_of(&point.spectrum, symmetry, neutral));
        let [first, last] = [growing(&a), growing(&b)];
        let mut tried = Vec::new();
        for k in first.min(last)..first.max(last) {
            let (Some(one), Some(other)) = (a.get(k), b.get(k)) else { continue };
            // From the end that is nearer to the crossing.
            let (state, mode) =
                if one.value.re.abs() < other.value.re.abs() { (&before.state, one) } else { (&after.state, other) };
            if tried.contains(&mode) {
                continue;
            }
            tried.push(mode);
            let confirmed = |critical: &Critical| {
                let at = parameter.get(critical.state.setup()).unwrap_or(f64::NAN);
                let near = (at - before.value).abs() <= 1.5 * width && (at - after.value).abs() <= 1.5 * width;
                near && crosses(critical, parameter, neutral).unwrap_or(false)
            };
            // Beside neutral modes the one that crosses cannot be told from them by its eigenvalue alone.
            let direct = || state.critical(mode, parameter).ok();
            let direct = (neutral == 0).then(direct).flatten().filter(&confirmed);
            // Needed where another mode is nearer to zero at the ends than the one that crosses.
            let halved =
                || halved(parameter, [before, after], (symmetry, neutral), (k, first > last)).filter(&confirmed);
            let Some(critical) = direct.or_else(halved) else { continue };
            let kind = if critical.mode.value.im < NEUTRAL * critical.state.diffusion_rate() {
                SpecialKind::BranchPoint
            } else {
                SpecialKind::Hopf
            };
            found.push(SpecialPoint::new(kind, critical, parameter));
        }
    }
    found
}

/// Returns true if the number of growing modes of the symmetry of a critical mode differs on the two sides of its
/// point, by the spectra there.
fn crosses(critical: &Critical, parameter: Parameter, neutral: usize) -> Result<bool, SteadyError> {
    let Critical { state, mode } = critical;
    let (at, unit) = (parameter.get(state.setup()).unwrap_or(f64::NAN), parameter.scale(state.setup()));
    let count = |state: &SteadyState, side: f64| -> Result<usize, SteadyError> {
        let spectrum = state.at(parameter, at + side * BESIDE * unit)?.spectrum()?;
        Ok(growing(&modes_of(&spectrum, mode.symmetry, neutral)))
    };
    Ok(count(state, -1.0)? != count(state, 1.0)?)
}

/// Returns the critical point between two points of a branch where mode k of a symmetry, in the order of growth rates
/// without the neutral ones, crosses zero growth: by halving the step, then by secants.
fn halved(
    parameter: Parameter,
    [before, after]: [&BranchPoint; 2],
    (symmetry, neutral): (Symmetry, usize),
    (k, grows_before): (usize, bool),
) -> Option<Critical> {
    let [mut low, mut high] = [before.value, after.value];
    let mut state = before.state.clone();
    let mut nearest = None;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        state = state.at(parameter, middle).ok()?;
        let mode = modes_of(&state.spectrum().ok()?, symmetry, neutral).into_iter().nth(k)?;
        *(if (mode.value.re > 0.0) == grows_before { &mut low } else { &mut high }) = middle;
        nearest = Some(mode);
    }
    let mode = nearest?;
    if neutral == 0 || mode.value.im > NEUTRAL.sqrt() * state.diffusion_rate() {
        return state.critical(&mode, parameter).ok();
    }
    real_critical(&state, parameter, (symmetry, neutral), [low, high])
}

/// Returns the critical point of a real mode among neutral ones, by secants on the sum of their eigenvalues. Each is
/// off by the square root of the Jacobian's error if they meet at zero, but their sum is not.
fn real_critical(
    start: &SteadyState,
    parameter: Parameter,
    (symmetry, neutral): (Symmetry, usize),
    [mut before, mut now]: [f64; 2],
) -> Option<Critical> {
    let sum = |value: f64| -> Option<(f64, SteadyState)> {
        let state = start.at(parameter, value).ok()?;
        let mut rates: Vec<_> = modes_of(&state.spectrum().ok()?, symmetry, 0).iter().map(|mode| mode.value).collect();
        rates.sort_by(|a, b| a.norm().total_cmp(&b.norm()));
        Some((rates.iter().take(neutral + 1).map(|rate| rate.re).sum(), state))
    };
    let mut rate_before = sum(before)?.0;
    for _ in 0..MOST_ITERATIONS {
        let (rate, state) = sum(now)?;
        if rate.abs() < NO_GROWTH * start.diffusion_rate() {
            return Some(Critical { state, mode: Eigenmode { value: rate.into(), symmetry } });
        }
        let next = now - rate * (now - before) / (rate - rate_before);
        (before, rate_before, now) = (now, rate, next);
    }
    None
}

/// Returns the number of modes that grow.
fn growing(modes: &[Eigenmode]) -> usize {
    modes.iter().filter(|mode| mode.value.re > 0.0).count()
}

/// Returns the number of eigenvalues of a symmetry that count as zero, in units of D/R^2 = `rate`.
fn neutral_modes(spectrum: &Spectrum, symmetry: Symmetry, rate: f64) -> usize {
    modes_of(spectrum, symmetry, 0).iter().filter(|mode| mode.value.norm() < NEUTRAL * rate).count()
}

/// Returns the modes of a symmetry but the `neutral` ones nearest to zero, conjugate pairs twice: a pair that parts
/// into two real modes is then no crossing.
fn modes_of(spectrum: &Spectrum, symmetry: Symmetry, neutral: usize) -> Vec<Eigenmode> {
    let modes = spectrum.modes.iter().filter(|mode| mode.symmetry == symmetry);
    let mut modes: Vec<Eigenmode> =
        modes.flat_map(|mode| std::iter::repeat_n(mode.clone(), mode.multiplicity())).collect();
    for _ in 0..neutral {
        let size = |k: &usize| modes[*k].value.norm();
        if let Some(smallest) = (0..modes.len()).min_by(|a, b| size(a).total_cmp(&size(b))) {
            modes.remove(smallest);
        }
    }
    modes
}

#[cfg(test)]
mod tests;
