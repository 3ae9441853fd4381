//! Fluctuations of numbers.

use motile_base::Vec2;

/// Returns the mean and variance of the number of places in the cells of a rectangle of these lengths (length) around
/// the origin, divided `divisions` times in x and y and taken as periodic. Of independent places the variance is the
/// mean; giant fluctuations are those whose variance grows faster than the mean where cells grow.
///
/// ```
/// use motile_analysis::suspension::number_fluctuations;
/// use motile_base::Vec2;
///
/// let places = [Vec2::new(-0.5, -0.5), Vec2::new(1.5, 1.5), Vec2::new(0.5, 0.5)];
/// assert_eq!(number_fluctuations(&places, [2.0, 2.0], [2, 2]), [0.75, 0.6875]);
/// ```
#[must_use]
pub fn number_fluctuations(places: &[Vec2], lengths: [f64; 2], divisions: [usize; 2]) -> [f64; 2] {
    let divisions = divisions.map(|count| count.max(1));
    let mut counts = vec![0.0; divisions[0] * divisions[1]];
    for place in places {
        let [x, y] = [0, 1].map(|axis| {
            let part = (place[axis] / lengths[axis] + 0.5).rem_euclid(1.0);
            ((part * divisions[axis] as f64) as usize).min(divisions[axis] - 1)
        });
        counts[x + divisions[0] * y] += 1.0;
    }
    let mean = counts.iter().sum::<f64>() / counts.len() as f64;
    [mean, counts.iter().map(|count| (count - mean).powi(2)).sum::<f64>() / counts.len() as f64]
}
