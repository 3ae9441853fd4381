//! Numbers that are found from points (x, y).

use serde::Deserialize;

/// Results of the points of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Measure {
    /// Mean of y and its standard deviation.
    Mean,
    Least,
    Greatest,
    /// How many points y is not 0 of, and of how many.
    Count,
    /// The share of these, with Wilson's interval of one standard error and of two.
    Share,
    /// Correlation coefficient of x and y, of five points or more, with the probability of one as large without any.
    Correlation,
    /// Largest residual of the line of [`Measure::Line`].
    Residual,
    /// Least squares of exp(-x/b): b, with the largest residual.
    Decay,
    /// Slope of a line through the origin, the mean of y/x, and its standard deviation relative to that.
    Slope,
    /// Least squares of a + b x: b, with its standard error.
    Line,
    /// The a of that line, with its standard error.
    Intercept,
    /// Least squares of a exp(-x/b) + c: b, with the largest residual relative to the range of y.
    Exponential,
    /// Largest less least y over their mean, of points with the same x, the mean over all x (of one x: 0).
    Spread,
    /// The largest of these rather than their mean.
    Widest,
    /// At how many x, of those with several points, y has both signs.
    Flips,
    /// Of the x with several points, how many have a sum of y above 0, of those whose y do not cancel, with the exact
    /// probability that chance alone takes as many or more one way (the sign test).
    Sign,
    /// The exact probability that chance alone takes as many or more of these above 0 (the one-sided sign test).
    SignChance,
    /// Where y changes its sign, by linear interpolation; the last of these places.
    Zero,
    /// Where y is greatest.
    Peak,
    /// The y of the last x over that of the first, less 1.
    Gain,
    /// How far the least y lies below the y of the last x, over that y: 0 if the last one is the least.
    Undershoot,
}

/// Fewest points of a correlation.
const FEWEST: usize = 5;

/// A number, and what is said beside it.
pub(super) type Found = (f64, String);

impl Measure {
    /// Of points in the order of x.
    pub(super) fn of(self, points: &[(f64, f64)]) -> Found {
        let n = points.len() as f64;
        let alone = |value: f64| (value, String::new());
        let ys = || points.iter().map(|(_, y)| *y);
        match self {
            Self::Mean => {
                let (mean, deviation) = mean(ys());
                (mean, if deviation > 0.0 { format!("standard deviation {}", shown(deviation)) } else { String::new() })
            }
            Self::Least => alone(ys().fold(f64::NAN, f64::min)),
            Self::Greatest => alone(ys().fold(f64::NAN, f64::max)),
            Self::Count => (ys().filter(|y| *y != 0.0).count() as f64, format!("of {}", points.len())),
            Self::Share => {
                let share = ys().filter(|y| *y != 0.0).count() as f64 / n;
                let [one, two] = [1.0, 2.0].map(|z| wilson(share, n, z).map(shown).join(" to "));
                (share, format!("of {n}, one standard error {one}, two {two}"))
            }
            Self::Correlation => {
                if points.len() < FEWEST {
                    return (f64::NAN, format!("of {n} points: too few"));
                }
                let (xx, xy, yy) = moments(points);
                let r = xy / (xx * yy).sqrt();
                (r, format!("of {n} points, p = {}", chance(r, points.len())))
            }
            Self::Residual => alone(line(points, |x| x).2),
            Self::Decay => {
                let (b, worst) = decay(points);
                (b, format!("largest residual {}", shown(worst)))
            }
            Self::Slope => {
                let (slope, deviation) = mean(points.iter().map(|(x, y)| y / x));
                (slope, format!("scatter {:.2} %", 100.0 * deviation / slope.abs()))
            }
            Self::Line => {
                let (_, b, _) = line(points, |x| x);
                let (xx, xy, yy) = moments(points);
                let error = ((yy - xy * xy / xx).max(0.0) / (n - 2.0) / xx).sqrt();
                (b, format!("standard error {}", shown(error)))
            }
            Self::Intercept => {
                let (a, ..) = line(points, |x| x);
                let (xx, xy, yy) = moments(points);
                let middle = points.iter().map(|(x, _)| x / n).sum::<f64>();
                let scatter = (yy - xy * xy / xx).max(0.0) / (n - 2.0);
                let error = (scatter * (1.0 / n + middle * middle / xx)).sqrt();
                (a, format!("standard error {}", shown(error)))
            }
            Self::Exponential => {
                let (a, b, c, worst) = exponential(points);
                let range = ys().fold(f64::NAN, f64::max) - ys().fold(f64::NAN, f64::min);
                let residual = format!("largest residual {:.1} % of the range", 100.0 * worst / range);
                (b, format!("a = {}, c = {}, {residual}", shown(a), shown(c)))
            }
            Self::Spread => alone(mean(spreads(points)).0),
            Self::Widest => alone(spreads(points).fold(f64::NAN, f64::max)),
            Self::Flips => {
                let both = |group: &[(f64, f64)]| group.iter().any(|p| p.1 > 0.0) && group.iter().any(|p| p.1 < 0.0);
                let count = several(points).filter(|group| both(group)).count();
                (count as f64, format!("of {}", several(points).count()))
            }
            Self::Sign => {
                let ([up, down], all) = signs(points);
                let p = shown(sign_test(up, down));
                (up as f64, format!("of {}, of all {all}, p = {p}", up + down))
            }
            Self::SignChance => {
                let ([up, down], all) = signs(points);
                (coins(up, up + down), format!("{up} of {}, of all {all}", up + down))
            }
            Self::Zero => {
                let crossing = |pair: &[(f64, f64)]| {
                    let [(x, y), (next, other)] = [pair[0], pair[1]];
                    (y * other < 0.0).then(|| x - y * (next - x) / (other - y))
                };
                alone(points.windows(2).rev().find_map(crossing).unwrap_or(f64::NAN))
            }
            Self::Gain => match points {
                [first, .., last] => alone(last.1 / first.1 - 1.0),
                _ => alone(f64::NAN),
            },
            Self::Undershoot => {
                let last = points.last().map_or(f64::NAN, |(_, y)| *y);
                alone((last - ys().fold(f64::NAN, f64::min)) / last.abs())
            }
            Self::Peak => alone(points.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map_or(f64::NAN, |(x, _)| *x)),
        }
    }
}

/// Mean and standard deviation (of the sample; 0 of one).
pub(crate) fn mean(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    let squares: f64 = values.map(|v| (v - mean).powi(2)).sum();
    (mean, (squares / (n - 1.0).max(1.0)).sqrt())
}

/// Sums of squares and of products about the means.
fn moments(points: &[(f64, f64)]) -> (f64, f64, f64) {
    let n = points.len() as f64;
    let (mx, my) = points.iter().fold((0.0, 0.0), |(a, b), (x, y)| (a + x / n, b + y / n));
    points.iter().fold((0.0, 0.0, 0.0), |(xx, xy, yy), (x, y)| {
        (xx + (x - mx).powi(2), xy + (x - mx) * (y - my), yy + (y - my).powi(2))
    })
}

/// Least squares of y = a + b f(x): a, b, largest residual.
pub(crate) fn line(points: &[(f64, f64)], f: impl Fn(f64) -> f64) -> (f64, f64, f64) {
    let mapped: Vec<(f64, f64)> = points.iter().map(|(x, y)| (f(*x), *y)).collect();
    let (xx, xy, _) = moments(&mapped);
    let b = xy / xx;
    let a = mapped.iter().map(|(x, y)| y - b * x).sum::<f64>() / mapped.len() as f64;
    (a, b, mapped.iter().map(|(x, y)| (y - a - b * x).abs()).fold(0.0, f64::max))
}

/// Least squares of a exp(-x/b) + c, of the b that leaves the least residual: a, b, c, largest residual.
pub(super) fn exponential(points: &[(f64, f64)]) -> (f64, f64, f64, f64) {
    let range = points.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), (x, _)| (a.min(*x), b.max(*x)));
    let width = range.1 - range.0;
    let fits = (0..400).map(|k| {
        let b = 0.02 * width * 500_f64.powf(f64::from(k) / 399.0);
        let (c, a, worst) = line(points, |x| (-(x - range.0) / b).exp());
        (a * (range.0 / b).exp(), b, c, worst)
    });
    let found = fits.filter(|fit| fit.3.is_finite()).min_by(|a, b| a.3.total_cmp(&b.3));
    found.unwrap_or((f64::NAN, f64::NAN, f64::NAN, f64::NAN))
}

/// The probability that points of no correlation have one of this size or more, by Student's distribution: with
/// r = sin(angle) its density is cos(angle)^(n - 3).
fn chance(r: f64, n: usize) -> String {
    let power = n as i32 - 3;
    let part = |from: f64| {
        let (steps, to) = (2000, std::f64::consts::FRAC_PI_2);
        let width = (to - from) / f64::from(steps);
        (0..steps).map(|k| (from + (f64::from(k) + 0.5) * width).cos().powi(power)).sum::<f64>() * width
    };
    let p = part(r.abs().min(1.0).asin()) / part(0.0);
    if p < 1e-4 { "below 1e-4".to_owned() } else { format!("{p:.2}").replace("0.00", "below 0.005") }
}

/// Least squares of exp(-x/b): b and the largest residual.
fn decay(points: &[(f64, f64)]) -> (f64, f64) {
    let largest = points.iter().map(|(x, _)| x.abs()).fold(0.0, f64::max);
    let residuals = |b: f64| points.iter().map(move |(x, y)| (y - (-x / b).exp()).abs());
    let squares = |b: &f64| residuals(*b).map(|r| r * r).sum::<f64>();
    let widths = (0..4000).map(|k| 1e-3 * largest * 1e4_f64.powf(f64::from(k) / 3999.0));
    let b = widths.min_by(|a, b| squares(a).total_cmp(&squares(b))).unwrap_or(f64::NAN);
    (b, residuals(b).fold(0.0, f64::max))
}

/// Wilson's interval of a proportion of n, of z standard errors.
fn wilson(share: f64, n: f64, z: f64) -> [f64; 2] {
    let (middle, scale) = (share + z * z / (2.0 * n), 1.0 + z * z / n);
    let half = z * (share * (1.0 - share) / n + z * z / (4.0 * n * n)).sqrt();
    [(middle - half) / scale, (middle + half) / scale]
}

/// Of points with the same x, how many have a sum of y above 0 and how many below, and how many sums there are.
fn signs(points: &[(f64, f64)]) -> ([usize; 2], usize) {
    let sums: Vec<f64> = several(points).map(|group| group.iter().map(|p| p.1).sum()).collect();
    ([1.0, -1.0].map(|sign| sums.iter().filter(|sum| sign * **sum > 1e-9).count()), sums.len())
}

/// The probability that fair coins show sides as unequally as `up` and `down` or more so, by the binomial
/// distribution.
fn sign_test(up: usize, down: usize) -> f64 {
    (2.0 * coins(up.max(down), up + down)).min(1.0)
}

/// The probability that `count` or more of `all` fair coins show heads.
fn coins(count: usize, all: usize) -> f64 {
    let mut term = 0.5_f64.powi(all as i32);
    let mut tail = 0.0;
    for k in 0..=all - count.min(all) {
        tail += term;
        term *= (all - k) as f64 / (k + 1) as f64;
    }
    tail
}

/// Points with the same x, where there are several.
fn several(points: &[(f64, f64)]) -> impl Iterator<Item = &[(f64, f64)]> + Clone {
    points.chunk_by(|a, b| same(a.0, b.0)).filter(|group| group.len() > 1)
}

/// Largest less least y over their mean, of points with the same x.
fn spreads(points: &[(f64, f64)]) -> impl Iterator<Item = f64> + Clone + '_ {
    several(points).map(|group| {
        let ys = || group.iter().map(|(_, y)| *y);
        (ys().fold(f64::NAN, f64::max) - ys().fold(f64::NAN, f64::min)) / mean(ys()).0.abs()
    })
}

/// True if two abscissas are one.
pub(super) fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * a.abs().max(b.abs())
}

/// A number to four significant figures.
pub(super) fn shown(value: f64) -> String {
    let magnitude = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    match magnitude {
        _ if !value.is_finite() => "none".to_owned(),
        -3..=5 => {
            let text = format!("{value:.*}", (3 - magnitude).max(0) as usize);
            if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
        }
        _ => format!("{value:.3e}"),
    }
}

#[cfg(test)]
mod tests;
