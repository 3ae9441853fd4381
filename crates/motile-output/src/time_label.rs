//! Times in the labels of pictures and plots.

use motile::base::internal::decimals;

/// Most decimals of a time.
const MOST: usize = 3;

/// A time (time) with one decimal, or with as many as tell it, at most three: 0.37 is not 0.4.
pub(crate) fn time_label(time: f64) -> String {
    let tells = |digits: usize| {
        let power = 10.0_f64.powi(digits as i32);
        ((time * power).round() / power - time).abs() <= 1e-9 * time.abs()
    };
    decimals((1..MOST).find(|&digits| tells(digits)).unwrap_or(MOST), time)
}

#[cfg(test)]
mod tests {
    use super::time_label;

    #[test]
    fn times_have_as_many_decimals_as_tell_them() {
        for (time, label) in [(0.0, "0.0"), (0.1 + 0.2, "0.3"), (0.37, "0.37"), (12.0, "12.0"), (0.947_059, "0.947")] {
            assert_eq!(time_label(time), label);
        }
    }
}
