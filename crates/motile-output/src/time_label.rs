//! Times in the labels of pictures and plots.

use motile::base::internal::decimals;

/// Most decimals of a time.
const MOST: usize = 3;

/// Returns a time (time) with one decimal, or with as many as it needs, at most three: 0.37 is not 0.4.
pub(crate) fn time_label(time: f64) -> String {
    let tells = |digits: usize| {
        let power = 10.0_f64.powi(digits as i32);
        ((time * power).round() / power - time).abs() <= 1e-9 * time.abs()
    };
    decimals((1..MOST).find(|&digits| tells(digits)).unwrap_or(MOST), time)
}

#[cfg(test)]
mod tests;
