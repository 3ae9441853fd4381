//! Ways and turns of droplets over time.

use motile_base::Vec2;

/// Returns the mean square displacements (length squared) over 0, 1, ... intervals of states at equal times, each with
/// the places of all droplets (length, not wrapped) in one order. The mean is taken over all droplets and all starts.
/// States of other numbers of places than the first one end the list.
///
/// ```
/// use motile_analysis::suspension::mean_square_displacement;
/// use motile_base::Vec2;
///
/// let states: Vec<Vec<Vec2>> = (0..4).map(|k| vec![Vec2::new(2.0 * f64::from(k), 0.0)]).collect();
/// assert_eq!(mean_square_displacement(&states), [0.0, 4.0, 16.0, 36.0]);
/// ```
#[must_use]
pub fn mean_square_displacement(states: &[Vec<Vec2>]) -> Vec<f64> {
    over_lags(states, |from, to| (to - from).length_squared())
}

/// Returns the means of the products `n(t) n(t + lag)` of directions (no dimension) over 0, 1, ... intervals, as
/// [`mean_square_displacement`] does.
#[must_use]
pub fn heading_correlation(states: &[Vec<Vec2>]) -> Vec<f64> {
    over_lags(states, Vec2::dot)
}

/// Returns the rotational diffusion constant (1/time) of directions whose correlation over 0, 1, ... intervals (time)
/// is `exp(-D t)`: the least squares of `-ln C = D t` over the lags from the first to the last before C falls below
/// 1/e, or three lags where it falls faster; `None` without a lag, or where C is not positive at the first.
///
/// ```
/// use motile_analysis::suspension::rotational_diffusion;
///
/// let correlation: Vec<f64> = (0..50).map(|k| (-0.3 * 0.1 * f64::from(k)).exp()).collect();
/// assert!((rotational_diffusion(&correlation, 0.1).unwrap() - 0.3).abs() < 1e-12);
/// ```
#[must_use]
pub fn rotational_diffusion(correlation: &[f64], interval: f64) -> Option<f64> {
    const FEWEST: usize = 3;
    let least = (-1.0_f64).exp();
    let lags = correlation.iter().enumerate().skip(1);
    let counted = lags.take_while(|&(lag, &c)| c > 0.0 && (c >= least || lag <= FEWEST));
    let [sum, squares] = counted.fold([0.0; 2], |[sum, squares], (lag, c)| {
        let time = lag as f64 * interval;
        [sum - time * c.ln(), squares + time * time]
    });
    (squares > 0.0).then(|| sum / squares)
}

/// Means of a function of two states of a droplet over droplets and starts, for each lag.
fn over_lags(states: &[Vec<Vec2>], of: impl Fn(Vec2, Vec2) -> f64) -> Vec<f64> {
    let Some(count) = states.first().map(Vec::len).filter(|count| *count > 0) else { return Vec::new() };
    let states = &states[..states.iter().position(|state| state.len() != count).unwrap_or(states.len())];
    let mean = |lag: usize| {
        let pairs = states.iter().zip(&states[lag..]).flat_map(|(from, to)| from.iter().zip(to));
        pairs.map(|(from, to)| of(*from, *to)).sum::<f64>() / ((states.len() - lag) * count) as f64
    };
    (0..states.len()).map(mean).collect()
}
