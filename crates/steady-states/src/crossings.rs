//! Special points between two points of a branch, where modes cross zero growth.

use crate::branch::{BranchPoint, SpecialKind, SpecialPoint};
use crate::{Critical, Eigenmode, Parameter, Spectrum, Symmetry};

/// Eigenvalue over D/R^2 that counts as zero: a double one, as of a shift and the velocity that it starts, errs by the
/// square root of the error of the Jacobian, 1e-10.
const NEUTRAL: f64 = 1e-5;
/// Differences of parameter (relative), speed and frequency (in units of D/R and D/R^2) up to which two special points
/// are one, found from both sides.
const SAME: f64 = 1e-4;
/// Halvings of a step before secants: a mode is then nearer to its crossing than to other modes.
const HALVINGS: usize = 6;

/// True for two findings of one special point.
pub(crate) fn is_same(one: &SpecialPoint, other: &SpecialPoint, parameter: Parameter) -> bool {
    let at = |point: &SpecialPoint| {
        let Critical { state, mode } = &point.critical;
        let value = parameter.get(state.setup()).unwrap_or(f64::NAN);
        (value, state.velocity().length() / state.diffusion_rate(), mode.value.im / state.diffusion_rate())
    };
    let ((a, u, f), (b, v, g)) = (at(one), at(other));
    let oscillates = |point: &SpecialPoint| point.kind == SpecialKind::Hopf;
    oscillates(one) == oscillates(other)
        && one.critical.mode.symmetry == other.critical.mode.symmetry
        && (a - b).abs() < SAME * a.abs()
        && (u - v).abs() < SAME
        && (f - g).abs() < SAME
}

/// Points where modes cross zero growth between two points of a branch.
pub(crate) fn crossings(parameter: Parameter, before: &BranchPoint, after: &BranchPoint) -> Vec<SpecialPoint> {
    let mut found = Vec::new();
    for symmetry in [Symmetry::Symmetric, Symmetry::Antisymmetric, Symmetry::None] {
        let [a, b] = [before, after].map(|point| modes_of(&point.spectrum, symmetry));
        let zero = before.spectrum.zero;
        let growing = |modes: &[Eigenmode]| modes.iter().filter(|mode| mode.value.re > zero).count();
        let [first, last] = [growing(&a), growing(&b)];
        let mut tried = Vec::new();
        for k in first.min(last)..first.max(last) {
            let (Some(one), Some(other)) = (a.get(k), b.get(k)) else { continue };
            // A neutral mode, such as the shift of a droplet at rest across a channel, crosses zero by round-off only.
            if one.value.norm().max(other.value.norm()) < NEUTRAL * before.state.diffusion_rate() {
                continue;
            }
            // From the end that is nearer to the crossing.
            let (state, mode) =
                if one.value.re.abs() < other.value.re.abs() { (&before.state, one) } else { (&after.state, other) };
            if tried.contains(&mode) {
                continue;
            }
            tried.push(mode);
            let near = |critical: &Critical| {
                let at = parameter.get(critical.state.setup()).unwrap_or(f64::NAN);
                let width = (after.value - before.value).abs();
                (at - before.value).abs() <= 1.5 * width && (at - after.value).abs() <= 1.5 * width
            };
            let direct = state.critical(mode, parameter).ok().filter(near);
            // Needed where another mode is nearer to zero at the ends than the one that crosses.
            let halved = || halved(parameter, [before, after], symmetry, (k, first > last)).filter(near);
            let Some(critical) = direct.or_else(halved) else { continue };
            let kind = if critical.mode.value.im < NEUTRAL * critical.state.diffusion_rate() {
                SpecialKind::BranchPoint
            } else {
                SpecialKind::Hopf
            };
            found.push(SpecialPoint { kind, critical });
        }
    }
    found
}

/// Critical point between two points of a branch where mode k of a symmetry, in the order of growth rates, crosses zero
/// growth: by halving the step, then by secants.
fn halved(
    parameter: Parameter,
    [before, after]: [&BranchPoint; 2],
    symmetry: Symmetry,
    (k, grows_before): (usize, bool),
) -> Option<Critical> {
    let [mut low, mut high] = [before.value, after.value];
    let mut state = before.state.clone();
    let mut nearest = None;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        state = state.at(parameter, middle).ok()?;
        let spectrum = state.spectrum().ok()?;
        let mode = modes_of(&spectrum, symmetry).into_iter().nth(k)?;
        *(if (mode.value.re > before.spectrum.zero) == grows_before { &mut low } else { &mut high }) = middle;
        nearest = Some(mode);
    }
    state.critical(&nearest?, parameter).ok()
}

/// Modes of a symmetry, conjugate pairs twice: a pair that parts into two real modes is then no crossing.
fn modes_of(spectrum: &Spectrum, symmetry: Symmetry) -> Vec<Eigenmode> {
    let modes = spectrum.modes.iter().filter(|mode| mode.symmetry == symmetry);
    modes.flat_map(|mode| std::iter::repeat_n(mode.clone(), mode.multiplicity())).collect()
}
