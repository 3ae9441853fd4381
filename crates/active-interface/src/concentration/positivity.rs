//! Keeping particle numbers from becoming negative.

use ib_core::input::all_finite;

use crate::InterfaceError;

/// What a repair of negative particle numbers did.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Repair {
    /// Segments whose number was negative.
    pub segments: usize,
    /// Particles moved.
    pub moved: f64,
    /// How many segments away the furthest of them came from.
    pub furthest: usize,
}

impl Repair {
    /// Adds another repair to this one, for a count over a run.
    pub(crate) fn accumulate(&mut self, other: Self) {
        self.segments += other.segments;
        self.moved += other.moved;
        self.furthest = self.furthest.max(other.furthest);
    }
}

/// Sets negative particle numbers to zero and takes what is missing from the two neighbours, in proportion to what they
/// have, and where they have too little from the segments further out. Afterwards no number is negative, and the total
/// is what it was but for round-off.
///
/// # Errors
/// Numbers that are not finite, and a total that is negative, so that there is not enough to take from. The numbers are
/// then as they were.
pub(crate) fn repair_positivity(numbers: &mut [f64]) -> Result<Repair, InterfaceError> {
    let mut repair = Repair::default();
    if numbers.iter().all(|&number| number >= 0.0 && number.is_finite()) {
        return Ok(repair);
    }
    all_finite("the particle numbers", numbers)?;
    let total: f64 = numbers.iter().sum();
    if total < 0.0 {
        return Err(InterfaceError::NoParticles { total });
    }
    let count = numbers.len();
    for k in 0..count {
        if numbers[k] >= 0.0 {
            continue;
        }
        let mut missing = -numbers[k];
        numbers[k] = 0.0;
        repair.segments += 1;
        repair.moved += missing;
        for distance in 1..=count / 2 {
            let (left, right) = ((k + count - distance) % count, (k + distance) % count);
            let here = numbers[left].max(0.0);
            let there = if left == right { 0.0 } else { numbers[right].max(0.0) };
            let available = here + there;
            if available <= 0.0 {
                continue;
            }
            repair.furthest = repair.furthest.max(distance);
            let share = (missing / available).min(1.0);
            if here > 0.0 {
                numbers[left] = (here - share * here).max(0.0);
            }
            if there > 0.0 {
                numbers[right] = (there - share * there).max(0.0);
            }
            missing -= share * available;
            if share < 1.0 {
                break;
            }
        }
    }
    Ok(repair)
}

#[cfg(test)]
mod tests;
