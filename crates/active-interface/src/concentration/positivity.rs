//! Repair of negative particle numbers.

use motile_base::internal::all_finite;

use crate::InterfaceError;

/// Extent of repairs of negative particle numbers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct Repair {
    /// Number of segments whose particle number was negative.
    pub segments: usize,
    /// Number of particles moved.
    pub moved: f64,
    /// Largest distance over which particles were moved, in segments.
    pub furthest: usize,
}

impl Repair {
    /// Adds another repair, for the sum over a run.
    pub(crate) fn accumulate(&mut self, other: Self) {
        self.segments += other.segments;
        self.moved += other.moved;
        self.furthest = self.furthest.max(other.furthest);
    }
}

/// Sets negative particle numbers to zero and takes the particles for it from the two neighbours, in proportion to
/// their numbers, and where these have too few from the segments further out. Afterwards no number is negative, and the
/// total is unchanged to round-off. All segments take at once, so that the mirror image of the numbers is repaired to
/// the mirror image of the repaired ones.
///
/// `missing` and `shares` are working arrays, as long as the numbers.
///
/// # Errors
/// Returns an error for numbers that are not finite, and a total that is negative, so that there is not enough to take
/// from. The numbers are then as they were.
pub(crate) fn repair_positivity(
    numbers: &mut [f64],
    [missing, shares]: [&mut [f64]; 2],
) -> Result<Repair, InterfaceError> {
    let mut repair = Repair::default();
    if numbers.iter().all(|&number| number >= 0.0 && number.is_finite()) {
        return Ok(repair);
    }
    all_finite("the particle numbers", numbers)?;
    let total: f64 = numbers.iter().sum();
    if total < 0.0 {
        return Err(InterfaceError::no_particles(total));
    }
    for (missing, number) in missing.iter_mut().zip(numbers.iter_mut()) {
        *missing = (-*number).max(0.0);
        if *missing > 0.0 {
            repair.segments += 1;
            repair.moved += *missing;
            *number = 0.0;
        }
    }
    let count = numbers.len();
    for distance in 1..=count / 2 {
        let around = |k: usize| [(k + count - distance) % count, (k + distance) % count];
        // Each of the two neighbours, once where they are the same one.
        let once = |[left, right]: [usize; 2], of: &[f64]| of[left] + if left == right { 0.0 } else { of[right] };
        // Where two segments ask one for more than it has it is left with nothing and they ask the others again.
        while (0..count).any(|k| missing[k] > 0.0 && once(around(k), numbers) > 0.0) {
            repair.furthest = distance;
            for (k, share) in shares.iter_mut().enumerate() {
                let available = once(around(k), numbers);
                *share = if missing[k] > 0.0 && available > 0.0 { (missing[k] / available).min(1.0) } else { 0.0 };
            }
            for k in (0..count).filter(|&k| shares[k] > 0.0) {
                let [left, right] = around(k).map(|other| 1.0 / once(around(other), shares).max(1.0));
                let served = left == 1.0 && right == 1.0 && shares[k] < 1.0;
                let [here, there] = around(k).map(|other| shares[k] * numbers[other]);
                let taken = left * here + if around(k)[0] == around(k)[1] { 0.0 } else { right * there };
                missing[k] = if served { 0.0 } else { (missing[k] - taken).max(0.0) };
            }
            for (k, number) in numbers.iter_mut().enumerate() {
                *number *= (1.0 - once(around(k), shares)).max(0.0);
            }
        }
    }
    Ok(repair)
}

#[cfg(test)]
mod tests;
